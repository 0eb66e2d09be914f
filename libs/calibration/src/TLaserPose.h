// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace salma::calibration {

/// T_c_l: from the laser's frame to the camera's.
struct TLaserPose {
    Eigen::Matrix3d R{Eigen::Matrix3d::Identity()};
    Eigen::Vector3d t{Eigen::Vector3d::Zero()};

    Eigen::Vector3d map(double x, double y) const { return R.col(0) * x + R.col(1) * y + t; }
};

/// normal . X = distance [m] in the camera's frame.
struct TPlane {
    Eigen::Vector3d normal{Eigen::Vector3d::UnitZ()};
    double distance{0};

    double offset(const Eigen::Vector3d& X) const { return normal.dot(X) - distance; }
};

}  // namespace salma::calibration
