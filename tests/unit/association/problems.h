// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/CDataAssociator.h>

#include <Eigen/Core>
#include <random>
#include <utility>

namespace salma::association::test {

inline TMeasurement seen(double range, double bearing, double sigma = 0.1) {
    TMeasurement measurement;
    measurement.z << range, bearing;
    measurement.R = Eigen::Matrix2d::Identity() * sigma * sigma;
    return measurement;
}

inline TMeasurement poster(double range, double bearing, double sigma = 0.1) {
    TMeasurement measurement = seen(range, bearing, sigma);
    measurement.kind = ELandmarkKind::salient;
    return measurement;
}

/// A problem without uncertainty of the map: S = R.
inline TAssociationProblem problem(std::vector<TMeasurement> measurements,
                                   const std::vector<Eigen::Vector2d>& landmarks,
                                   ELandmarkKind kind = ELandmarkKind::corner) {
    TAssociationProblem result;
    result.measurements = std::move(measurements);
    for (const Eigen::Vector2d& z : landmarks) {
        TPredictedLandmark landmark;
        landmark.kind = kind;
        landmark.z = z;
        result.landmarks.push_back(landmark);
    }
    const auto size = static_cast<Eigen::Index>(2 * landmarks.size());
    result.predictionCovariance = Eigen::MatrixXd::Zero(size, size);
    return result;
}

/// All predictions are off by the same unknown (range, bearing) of this deviation.
inline void addCommonError(TAssociationProblem& problem, double sigmaRange, double sigmaBearing) {
    const Eigen::Vector2d variances(sigmaRange * sigmaRange, sigmaBearing * sigmaBearing);
    for (Eigen::Index i = 0; i < problem.predictionCovariance.rows(); i += 2)
        for (Eigen::Index j = 0; j < problem.predictionCovariance.cols(); j += 2)
            problem.predictionCovariance.block<2, 2>(i, j) +=
                Eigen::Matrix2d(variances.asDiagonal());
}

/// Landmarks all over a disc, some of them seen, with a common error, missing and new ones.
inline TAssociationProblem randomProblem(std::mt19937& random) {
    std::uniform_real_distribution<double> range(1, 8);
    std::uniform_real_distribution<double> bearing(-M_PI, M_PI);
    std::normal_distribution<double> unit(0, 1);
    std::vector<Eigen::Vector2d> landmarks(12);
    for (Eigen::Vector2d& z : landmarks) z = {range(random), bearing(random)};
    TAssociationProblem result = problem({}, landmarks);
    addCommonError(result, 0.3, 0.1);
    const Eigen::Vector2d common(0.3 * unit(random), 0.1 * unit(random));
    for (std::size_t i = 0; i < 8; ++i)
        result.measurements.push_back(seen(landmarks[i][0] + common[0] + 0.1 * unit(random),
                                           landmarks[i][1] + common[1] + 0.1 * unit(random)));
    result.measurements.push_back(seen(range(random), bearing(random)));
    return result;
}

}  // namespace salma::association::test
