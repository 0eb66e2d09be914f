// SPDX-License-Identifier: BSD-3-Clause
#include "opencvTypes.h"

#include <mrpt/math/CMatrixFixed.h>

#include <opencv2/calib3d.hpp>

namespace salma::calibration {

std::vector<cv::Point3f> onPlane(const std::vector<mrpt::math::TPoint2D>& points) {
    std::vector<cv::Point3f> converted;
    converted.reserve(points.size());
    for (const auto& p : points)
        converted.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y), 0.0F);
    return converted;
}

std::vector<cv::Point2f> asPixels(const std::vector<mrpt::math::TPoint2D>& points) {
    std::vector<cv::Point2f> converted;
    converted.reserve(points.size());
    for (const auto& p : points)
        converted.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
    return converted;
}

cv::Matx33d cameraMatrix(const mrpt::img::TCamera& camera) {
    return {camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1};
}

std::vector<double> distortionOf(const mrpt::img::TCamera& camera) {
    if (camera.distortion == mrpt::img::DistortionModel::none) return std::vector<double>(5, 0.0);
    return {camera.k1(), camera.k2(), camera.p1(), camera.p2(), camera.k3()};
}

mrpt::poses::CPose3D poseFrom(const cv::Mat& rotationVector, const cv::Mat& translation) {
    cv::Matx33d R;
    cv::Rodrigues(rotationVector, R);
    mrpt::math::CMatrixDouble44 T;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) T(r, c) = R(r, c);
        T(r, 3) = translation.at<double>(r);
        T(3, r) = 0;
    }
    T(3, 3) = 1;
    return mrpt::poses::CPose3D(T);
}

}  // namespace salma::calibration
