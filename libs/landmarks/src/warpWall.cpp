// SPDX-License-Identifier: BSD-3-Clause
#include "warpWall.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace salma::landmarks {

TWallPicture warpWall(const cv::Mat& grey,
                      const appearance::CWallView& view,
                      const appearance::TWallRectangle& area,
                      const cv::Point2d& pixelsPerMetre) {
    const cv::Size size(static_cast<int>(std::ceil((area.u1 - area.u0) * pixelsPerMetre.x)) + 1,
                        static_cast<int>(std::ceil((area.v1 - area.v0) * pixelsPerMetre.y)) + 1);
    // The lens bends slowly: exact at every fourth wall point, linear in between.
    constexpr int kStep = 4;
    const cv::Size coarse(size.width / kStep + 2, size.height / kStep + 2);
    cv::Mat map(coarse, CV_32FC2);
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x) {
            const auto pixel = view.toPixel(area.u0 + x * kStep / pixelsPerMetre.x,
                                            area.v1 - y * kStep / pixelsPerMetre.y);
            map.at<cv::Vec2f>(y, x) =
                pixel ? cv::Vec2f(static_cast<float>(pixel->x), static_cast<float>(pixel->y))
                      : cv::Vec2f(-1e6F, -1e6F);
        }
    cv::Mat fine(size, CV_32FC2);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int cx = x / kStep, cy = y / kStep;
            const float fx = static_cast<float>(x % kStep) / kStep;
            const float fy = static_cast<float>(y % kStep) / kStep;
            fine.at<cv::Vec2f>(y, x) =
                (map.at<cv::Vec2f>(cy, cx) * (1 - fx) + map.at<cv::Vec2f>(cy, cx + 1) * fx) *
                    (1 - fy) +
                (map.at<cv::Vec2f>(cy + 1, cx) * (1 - fx) +
                 map.at<cv::Vec2f>(cy + 1, cx + 1) * fx) *
                    fy;
        }
    TWallPicture result;
    cv::remap(grey, result.grey, fine, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    std::vector<cv::Mat> xy;
    cv::split(fine, xy);
    result.valid =
        (xy[0] >= 0) & (xy[0] <= grey.cols - 1) & (xy[1] >= 0) & (xy[1] <= grey.rows - 1);
    return result;
}

}  // namespace salma::landmarks
