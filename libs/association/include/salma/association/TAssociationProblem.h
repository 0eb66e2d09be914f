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
template <int DIM>
struct TPredictedLandmarkOf {
    ELandmarkKind kind{ELandmarkKind::corner};
    TReading<DIM> z{TReading<DIM>::Zero()};
    bool visible{true};           //!< Within the sensor's reach; others are no candidates.
    std::optional<int> identity;  //!< As the log states it, if it ever did.
    /// Expected direction of the wall's normal [rad]; NaN if the wall is not known.
    double wallAngle{std::numeric_limits<double>::quiet_NaN()};
    double wallAngleSigma{0};  //!< With the uncertainty of the robot's heading [rad].
    bool convex{false};        //!< Of a corner: points towards the robot.
};

/// Measurements of one step against the landmarks of the map.
template <int DIM>
struct TAssociationProblemOf {
    std::vector<TMeasurementOf<DIM>> measurements;     //!< M, with their covariances R.
    std::vector<TPredictedLandmarkOf<DIM>> landmarks;  //!< N
    /// H P H' of all predictions together, without R [DIM N x DIM N], landmark by landmark.
    Eigen::MatrixXd predictionCovariance;
    /// Log likelihood ratio same/other of the appearance of a measurement and a landmark, called
    /// at most once per pair, only for pairs of salient landmarks that geometry allows; NaN means
    /// "cannot tell". Null: appearance is not used.
    std::function<double(std::size_t observation, std::size_t landmark)> logRatio;
    /// Probability from 0 to 1 that a landmark is inside the view of this step's sensors and not
    /// hidden. Null: 1 for all.
    std::function<double(std::size_t landmark)> visibility;
};

using TPredictedLandmark = TPredictedLandmarkOf<2>;
using TPredictedLandmark3D = TPredictedLandmarkOf<3>;
using TAssociationProblem = TAssociationProblemOf<2>;
using TAssociationProblem3D = TAssociationProblemOf<3>;

}  // namespace salma::association
