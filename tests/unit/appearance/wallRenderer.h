// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>
#include <salma/appearance/CRectifier.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

namespace salma::appearance::test {

/// The EVI-D30's horizontal field of 48.8 deg at 640x480, with some barrel distortion.
inline mrpt::img::TCamera pannedCamera() {
    mrpt::img::TCamera camera;
    camera.ncols = 640;
    camera.nrows = 480;
    camera.setIntrinsicParamsFromValues(705, 705, 319.5, 239.5);
    camera.distortion = mrpt::img::DistortionModel::plumb_bob;
    camera.dist.fill(0);
    camera.dist[0] = -0.12;
    camera.dist[1] = 0.03;
    return camera;
}

/// Camera at (x, y, z) of the robot that looks along `pan` (left positive) and `tilt` (up).
inline mrpt::poses::CPose3D panTiltPose(const mrpt::math::TPoint3D& at, double pan, double tilt) {
    const mrpt::poses::CPose3D optical(0, 0, 0, -M_PI / 2, 0, -M_PI / 2);
    return mrpt::poses::CPose3D(at.x, at.y, at.z, pan, -tilt, 0) + optical;
}

inline laser::TLine wallLine(double rho, double alpha) {
    laser::TLine line;
    line.rho = rho;
    line.alpha = alpha;
    const double c = std::cos(alpha);
    const double s = std::sin(alpha);
    line.from = {rho * c + 10 * s, rho * s - 10 * c};
    line.to = {rho * c - 10 * s, rho * s + 10 * c};
    line.covariance << 4e-6, 0, 0, 4e-6;
    return line;
}

struct TExposure {
    double blur{0};   //!< [px]
    double noise{0};  //!< [grey levels]
    double gain{1};
};

/// Picture of a poster that fills `place` on an evenly grey wall.
inline cv::Mat renderPoster(const CWallView& view,
                            const cv::Mat& poster,
                            const TWallRectangle& place,
                            const TExposure& exposure,
                            std::mt19937& random) {
    constexpr int kFine = 2;  // samples per pixel and axis
    const int cols = static_cast<int>(view.camera().ncols);
    const int rows = static_cast<int>(view.camera().nrows);
    // a texture much finer than the view would alias
    const double centre =
        std::max(1.0, view.pixelsPerMetre((place.u0 + place.u1) / 2, (place.v0 + place.v1) / 2));
    const double shrink = std::min(1.0, 2 * kFine * centre * (place.u1 - place.u0) / poster.cols);
    cv::Mat texture;
    cv::resize(poster, texture, {}, shrink, shrink, cv::INTER_AREA);
    cv::Mat mapX(rows * kFine, cols * kFine, CV_32F);
    cv::Mat mapY(rows * kFine, cols * kFine, CV_32F);
    const auto onTexture = [&](double c, double r) -> cv::Vec2f {
        const auto p = view.toWall({(c + 0.5) / kFine - 0.5, (r + 0.5) / kFine - 0.5});
        if (!p) return {-1e4F, -1e4F};
        const double u = (p->x - place.u0) / (place.u1 - place.u0);
        const double v = (place.v1 - p->y) / (place.v1 - place.v0);
        return {static_cast<float>(u * texture.cols - 0.5),
                static_cast<float>(v * texture.rows - 0.5)};
    };
    constexpr int kStride = 8;  // the map is smooth: in between, straight lines do
    for (int r = 0; r < mapX.rows; ++r)
        for (int c = 0; c < mapX.cols; c += kStride) {
            const cv::Vec2f a = onTexture(c, r);
            const cv::Vec2f step = (onTexture(c + kStride, r) - a) / kStride;
            for (int k = 0; k < kStride && c + k < mapX.cols; ++k) {
                mapX.at<float>(r, c + k) = a[0] + static_cast<float>(k) * step[0];
                mapY.at<float>(r, c + k) = a[1] + static_cast<float>(k) * step[1];
            }
        }
    cv::Mat fine, out;
    cv::remap(texture, fine, mapX, mapY, cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(150));
    cv::resize(fine, out, {cols, rows}, 0, 0, cv::INTER_AREA);
    if (exposure.blur > 0) cv::GaussianBlur(out, out, {}, exposure.blur);
    out.convertTo(out, -1, exposure.gain);
    std::normal_distribution<double> normal(0, 1);
    if (exposure.noise > 0)
        for (auto& g : cv::Mat_<std::uint8_t>(out))
            g = cv::saturate_cast<std::uint8_t>(g + exposure.noise * normal(random));
    return out;
}

}  // namespace salma::appearance::test
