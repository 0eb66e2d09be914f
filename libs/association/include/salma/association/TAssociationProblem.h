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

/// How likely a step's sensors measure a landmark, if it is there.
struct TDetectability {
    double inView{1};   //!< Probability that it is in view and not hidden, as far as is known.
    double found{0.5};  //!< Probability that it is measured if it is in view.

    double probability() const { return inView * found; }
};

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
    std::optional<TDetectability> detection;  //!< Nothing: in view, found as the options say.
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
};

using TPredictedLandmark = TPredictedLandmarkOf<2>;
using TPredictedLandmark3D = TPredictedLandmarkOf<3>;
using TAssociationProblem = TAssociationProblemOf<2>;
using TAssociationProblem3D = TAssociationProblemOf<3>;

}  // namespace salma::association
