// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/TPatch.h>

#include <Eigen/Core>

namespace salma::appearance {

/// What a filter in the plane takes from a patch, in the robot frame at the picture's time.
struct TPolarMeasurement {
    Eigen::Vector2d z{0, 0};                     //!< Range [m] and bearing [rad] of the centre.
    Eigen::Matrix2d R{Eigen::Matrix2d::Zero()};  //!< Covariance of z [m, rad].
    double wallAngle{0};       //!< Direction of the wall's normal towards the robot [rad].
    double wallAngleSigma{0};  //!< [rad]
    Eigen::Matrix3d full{Eigen::Matrix3d::Zero()};  //!< Of (range, bearing, wallAngle).
};

/// \throw std::invalid_argument if the centre of the patch is at the robot's origin.
TPolarMeasurement polarMeasurement(const observations::TPatch& patch);

}  // namespace salma::appearance
