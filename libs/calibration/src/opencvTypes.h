// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/poses/CPose3D.h>

#include <opencv2/core.hpp>
#include <vector>

namespace salma::calibration {

/// On the plane z = 0.
std::vector<cv::Point3f> onPlane(const std::vector<mrpt::math::TPoint2D>& points);
std::vector<cv::Point2f> asPixels(const std::vector<mrpt::math::TPoint2D>& points);
cv::Matx33d cameraMatrix(const mrpt::img::TCamera& camera);
/// k1, k2, p1, p2, k3.
std::vector<double> distortionOf(const mrpt::img::TCamera& camera);
mrpt::poses::CPose3D poseFrom(const cv::Mat& rotationVector, const cv::Mat& translation);

}  // namespace salma::calibration
