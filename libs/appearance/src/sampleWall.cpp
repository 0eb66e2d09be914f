// SPDX-License-Identifier: BSD-3-Clause
#include "sampleWall.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace salma::appearance {
namespace {

constexpr int kStep = 4;  // the lens bends slowly: exact at every fourth point, linear in between
constexpr int kMaxSamples = 16;  // of one pixel and axis

/// Pixels of the picture at every kStep-th sample, two more than needed.
cv::Mat coarseMap(const CWallView& view, const TWallRectangle& r, const cv::Size& size) {
    cv::Mat map(size.height / kStep + 2, size.width / kStep + 2, CV_32FC2);
    for (int row = 0; row < map.rows; ++row)
        for (int col = 0; col < map.cols; ++col) {
            const double u = r.u0 + (col * kStep + 0.5) / size.width * (r.u1 - r.u0);
            const double v = r.v1 - (row * kStep + 0.5) / size.height * (r.v1 - r.v0);
            const auto pixel = view.toPixel(u, v);
            map.at<cv::Vec2f>(row, col) =
                pixel ? cv::Vec2f(static_cast<float>(pixel->x), static_cast<float>(pixel->y))
                      : cv::Vec2f(-1e6F, -1e6F);
        }
    return map;
}

cv::Mat fineMap(const cv::Mat& coarse, const cv::Size& size) {
    cv::Mat map(size, CV_32FC2);
    for (int row = 0; row < size.height; ++row) {
        const auto* upper = coarse.ptr<cv::Vec2f>(row / kStep);
        const auto* lower = coarse.ptr<cv::Vec2f>(row / kStep + 1);
        const float down = static_cast<float>(row % kStep) / kStep;
        auto* out = map.ptr<cv::Vec2f>(row);
        for (int col = 0; col < size.width; ++col) {
            const int c = col / kStep;
            const float right = static_cast<float>(col % kStep) / kStep;
            out[col] = (upper[c] * (1 - right) + upper[c + 1] * right) * (1 - down) +
                       (lower[c] * (1 - right) + lower[c + 1] * right) * down;
        }
    }
    return map;
}

/// Samples along an axis of a pixel so that none of the picture's pixels is skipped.
int samplesFor(double finer, int pixels, double metres) {
    return std::clamp(static_cast<int>(std::ceil(finer * metres / pixels - 1e-9)), 1, kMaxSamples);
}

}  // namespace

TWallSample sampleWall(const cv::Mat& grey,
                       const CWallView& view,
                       const TWallRectangle& area,
                       const cv::Size& size) {
    const double width = area.u1 - area.u0;
    const double height = area.v1 - area.v0;
    const auto finest = view.pixelsPerMetreOfAxes((area.u0 + area.u1) / 2, (area.v0 + area.v1) / 2);
    const cv::Size fine(size.width * samplesFor(finest.first, size.width, width),
                        size.height * samplesFor(finest.second, size.height, height));
    const cv::Mat map = fineMap(coarseMap(view, area, fine), fine);
    TWallSample out;
    cv::remap(grey, out.grey, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::inRange(map, cv::Scalar(0, 0), cv::Scalar(grey.cols - 1, grey.rows - 1), out.valid);
    if (fine != size) {
        cv::resize(out.grey, out.grey, size, 0, 0, cv::INTER_AREA);
        cv::resize(out.valid, out.valid, size, 0, 0, cv::INTER_AREA);
        out.valid = out.valid == 255;
    }
    return out;
}

}  // namespace salma::appearance
