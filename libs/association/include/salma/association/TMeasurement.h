// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/TPatch.h>

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>

namespace salma::association {

enum class ELandmarkKind { salient, corner };

/// One sight of a possible landmark, in the robot frame at the step's time.
struct TMeasurement {
    ELandmarkKind kind{ELandmarkKind::corner};
    Eigen::Vector2d z{0, 0};                            //!< Range [m] and bearing [rad].
    Eigen::Matrix2d R{Eigen::Matrix2d::Identity()};     //!< Covariance of z [m, rad].
    std::optional<int> identity;                        //!< As the log states it, if it does.
    std::shared_ptr<const observations::TPatch> patch;  //!< Null for a landmark without appearance.
    /// Direction of the wall's normal towards the robot [rad]; only with a patch.
    double wallAngle{std::numeric_limits<double>::quiet_NaN()};
    double wallAngleSigma{0};  //!< [rad]
    bool convex{false};        //!< Of a corner: points towards the robot.
};

}  // namespace salma::association
