// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CWallView.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace salma::landmarks::test {

/// A camera of 640x480 with 45 deg of horizontal field, 1.2 m above the floor, turned by `pan`.
inline mrpt::img::TCamera camera() {
    mrpt::img::TCamera c;
    c.ncols = 640;
    c.nrows = 480;
    c.setIntrinsicParamsFromValues(770, 770, 319.5, 239.5);
    return c;
}

inline mrpt::poses::CPose3D cameraPose(double pan = 0) {
    return mrpt::poses::CPose3D(0, 0, 1.2, pan, 0, 0) +
           mrpt::poses::CPose3D(0, 0, 0, -M_PI_2, 0, -M_PI_2);
}

/// A wall square to the direction `alpha`, `rho` metres away, reaching 3 m to both sides.
inline laser::TLine wall(double rho, double alpha) {
    laser::TLine line;
    line.rho = rho;
    line.alpha = alpha;
    line.covariance = Eigen::Vector2d(1e-5, 1e-6).asDiagonal();
    const double c = std::cos(alpha), s = std::sin(alpha);
    line.from = {rho * c + 3 * s, rho * s - 3 * c};
    line.to = {rho * c - 3 * s, rho * s + 3 * c};
    return line;
}

/// Random blobs of several sizes: what a painting is to a detector.
inline cv::Mat painting(int rows, int cols, int seed) {
    cv::RNG random(seed);
    cv::Mat sum = cv::Mat::zeros(rows, cols, CV_32F);
    for (const int cell : {8, 24, 60}) {
        cv::Mat small(rows / cell + 2, cols / cell + 2, CV_32F), large;
        random.fill(small, cv::RNG::UNIFORM, -60, 60);
        cv::resize(small, large, {cols, rows}, 0, 0, cv::INTER_CUBIC);
        sum += large;
    }
    cv::Mat result;
    sum.convertTo(result, CV_8U, 1, 100);
    return result;
}

/// Picture of one wall with a painting between the wall coordinates (u0, v0) and (u1, v1).
inline cv::Mat pictureOf(const appearance::CWallView& view,
                         const cv::Rect2d& area,
                         int seed,
                         double noise = 2) {
    const cv::Mat art = painting(300, 300, seed);
    cv::Mat picture(480, 640, CV_8U);
    cv::RNG random(seed + 1);
    for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.cols; ++x) {
            double grey = 190;
            if (const auto at = view.toWall({double(x), double(y)})) {
                const double a = (at->x - area.x) / area.width, b = (at->y - area.y) / area.height;
                if (a >= 0 && a < 1 && b > 0 && b <= 1)
                    grey = art.at<uchar>(int((1 - b) * 300), int(a * 300)) * 0.7;
            }
            picture.at<uchar>(y, x) = cv::saturate_cast<uchar>(grey + random.gaussian(noise));
        }
    return picture;
}

}  // namespace salma::landmarks::test
