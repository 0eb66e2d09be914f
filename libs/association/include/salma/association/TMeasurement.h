// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/TPatch.h>

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>

namespace salma::association {

enum class ELandmarkKind { salient, corner };

/// What a sensor reads of a landmark: range [m] and bearing [rad] (DIM = 2), or range [m], yaw and
/// pitch [rad] (DIM = 3).
template <int DIM>
using TReading = Eigen::Matrix<double, DIM, 1>;
template <int DIM>
using TReadingCovariance = Eigen::Matrix<double, DIM, DIM>;

/// One sight of a possible landmark, in the robot frame at the step's time.
template <int DIM>
struct TMeasurementOf {
    ELandmarkKind kind{ELandmarkKind::corner};
    TReading<DIM> z{TReading<DIM>::Zero()};
    TReadingCovariance<DIM> R{TReadingCovariance<DIM>::Identity()};  //!< Of z [m, rad].
    std::optional<int> identity;                        //!< As the log states it, if it does.
    std::shared_ptr<const observations::TPatch> patch;  //!< Null for a landmark without appearance.
    /// Direction of the wall's normal towards the robot [rad]; only with a patch.
    double wallAngle{std::numeric_limits<double>::quiet_NaN()};
    double wallAngleSigma{0};  //!< [rad]
    bool convex{false};        //!< Of a corner: points towards the robot.
};

using TMeasurement = TMeasurementOf<2>;
using TMeasurement3D = TMeasurementOf<3>;

}  // namespace salma::association
