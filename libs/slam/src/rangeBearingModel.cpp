// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/rangeBearingModel.h>

#include <algorithm>
#include <cmath>

namespace salma::slam {

TMotion moved(const Eigen::Vector3d& pose, const Eigen::Vector3d& increment) {
    const double c = std::cos(pose[2]);
    const double s = std::sin(pose[2]);
    const double dx = c * increment[0] - s * increment[1];
    const double dy = s * increment[0] + c * increment[1];
    TMotion result;
    result.pose << pose[0] + dx, pose[1] + dy, mrpt::math::wrapToPi(pose[2] + increment[2]);
    result.byPose << 1, 0, -dy, 0, 1, dx, 0, 0, 1;
    result.byIncrement << c, -s, 0, s, c, 0, 0, 0, 1;
    return result;
}

TSighting sighting(const Eigen::Vector3d& pose, const Eigen::Vector2d& landmark) {
    const double dx = landmark[0] - pose[0];
    const double dy = landmark[1] - pose[1];
    const double range = std::max(std::hypot(dx, dy), 1e-3);
    const double range2 = range * range;
    TSighting result;
    result.z << std::hypot(dx, dy), mrpt::math::wrapToPi(std::atan2(dy, dx) - pose[2]);
    result.byLandmark << dx / range, dy / range, -dy / range2, dx / range2;
    result.byPose << -result.byLandmark, Eigen::Vector2d(0, -1);
    return result;
}

TLocated located(const Eigen::Vector3d& pose, const Eigen::Vector2d& z) {
    const double c = std::cos(pose[2] + z[1]);
    const double s = std::sin(pose[2] + z[1]);
    TLocated result;
    result.landmark << pose[0] + z[0] * c, pose[1] + z[0] * s;
    result.byPose << 1, 0, -z[0] * s, 0, 1, z[0] * c;
    result.byMeasurement << c, -z[0] * s, s, z[0] * c;
    return result;
}

}  // namespace salma::slam
