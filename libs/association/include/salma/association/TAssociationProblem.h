// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TMeasurement.h>

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace salma::association {

/// What the map expects to see of a landmark, in the robot frame at the step's time.
struct TPredictedLandmark {
    ELandmarkKind kind{ELandmarkKind::corner};
    Eigen::Vector2d z{0, 0};      //!< Predicted range [m] and bearing [rad].
    bool visible{true};           //!< Within the sensor's reach; others are no candidates.
    std::optional<int> identity;  //!< As the log states it, if it ever did.
    /// Expected direction of the wall's normal [rad]; NaN if the wall is not known.
    double wallAngle{std::numeric_limits<double>::quiet_NaN()};
    double wallAngleSigma{0};  //!< With the uncertainty of the robot's heading [rad].
    bool convex{false};        //!< Of a corner: points towards the robot.
};

/// Measurements of one step against the landmarks of the map.
struct TAssociationProblem {
    std::vector<TMeasurement> measurements;     //!< M, with their covariances R.
    std::vector<TPredictedLandmark> landmarks;  //!< N
    /// H P H' of all predictions together, without R [2N x 2N], range and bearing in turn.
    Eigen::MatrixXd predictionCovariance;
    /// Log likelihood ratio same/other of the appearance of a measurement and a landmark, called
    /// at most once per pair, only for pairs of salient landmarks that geometry allows; NaN means
    /// "cannot tell". Null: appearance is not used.
    std::function<double(std::size_t observation, std::size_t landmark)> logRatio;
    /// Probability from 0 to 1 that a landmark is inside the view of this step's sensors and not
    /// hidden. Null: 1 for all.
    std::function<double(std::size_t landmark)> visibility;
};

}  // namespace salma::association
