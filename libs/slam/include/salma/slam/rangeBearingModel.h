// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace salma::slam {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

/// A motion: the new pose and its derivatives.
struct TMotion {
    Eigen::Vector3d pose;  //!< (x, y, heading) [m, rad]; the heading is wrapped.
    Eigen::Matrix3d byPose;
    Eigen::Matrix3d byIncrement;
};

/// Pose after moving by `increment` = (x, y, turn) in the frame of `pose` [m, rad].
TMotion moved(const Eigen::Vector3d& pose, const Eigen::Vector3d& increment);

/// An expected measurement and its derivatives.
struct TSighting {
    Eigen::Vector2d z;  //!< Range [m] and bearing, wrapped [rad].
    Matrix23 byPose;
    Eigen::Matrix2d byLandmark;
};

/// What a robot at `pose` measures of a landmark at (x, y) [m]. The derivatives of a landmark
/// nearer than 1 mm are those at 1 mm.
TSighting sighting(const Eigen::Vector3d& pose, const Eigen::Vector2d& landmark);

/// A landmark located from a measurement, and the derivatives of its position.
struct TLocated {
    Eigen::Vector2d landmark;  //!< World [m].
    Matrix23 byPose;
    Eigen::Matrix2d byMeasurement;
};

/// Where a landmark lies of which a robot at `pose` measures z = (range, bearing) [m, rad].
TLocated located(const Eigen::Vector3d& pose, const Eigen::Vector2d& z);

}  // namespace salma::slam
