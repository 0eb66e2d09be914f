// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/CDataAssociator.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
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

/// Up to five measurements and six landmarks so near to each other that many hypotheses are open.
inline TAssociationProblem smallProblem(std::mt19937& random) {
    std::uniform_real_distribution<double> range(2, 4);
    std::uniform_real_distribution<double> bearing(M_PI - 0.4, M_PI + 0.4);  // across the half turn
    std::normal_distribution<double> unit(0, 1);
    std::vector<Eigen::Vector2d> landmarks(1 + random() % 6);
    for (Eigen::Vector2d& z : landmarks) z = {range(random), bearing(random)};
    TAssociationProblem result = problem({}, landmarks);
    const double scale = 0.1 + 0.1 * static_cast<double>(random() % 4);
    addCommonError(result, scale, scale);
    // Errors of the landmarks themselves, correlated between neighbours in the list.
    const auto size = result.predictionCovariance.rows();
    Eigen::MatrixXd mixing = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
        for (Eigen::Index j = std::max<Eigen::Index>(0, i - 3); j <= i; ++j)
            mixing(i, j) = 0.05 * unit(random);
    result.predictionCovariance += mixing * mixing.transpose();
    const Eigen::Vector2d common(scale * unit(random), scale * unit(random));
    const std::size_t seenCount = 1 + random() % 5;
    for (std::size_t i = 0; i < seenCount; ++i) {
        const Eigen::Vector2d z = i < landmarks.size()
                                      ? Eigen::Vector2d(landmarks[i] + common)
                                      : Eigen::Vector2d(range(random), bearing(random));
        TMeasurement measurement = seen(z[0] + 0.1 * unit(random), z[1] + 0.1 * unit(random));
        measurement.R(0, 1) = measurement.R(1, 0) = 0.005 * std::tanh(unit(random));
        result.measurements.push_back(measurement);
    }
    return result;
}

/// A small problem in space: those of the plane with a pitch, coupled with all else.
inline TAssociationProblem3D smallProblem3D(std::mt19937& random) {
    std::uniform_real_distribution<double> pitch(-0.4, 0.4);
    std::normal_distribution<double> unit(0, 1);
    const TAssociationProblem flat = smallProblem(random);
    TAssociationProblem3D result;
    const auto count = static_cast<Eigen::Index>(flat.landmarks.size());
    result.predictionCovariance.setZero(3 * count, 3 * count);
    for (Eigen::Index i = 0; i < count; ++i) {
        TPredictedLandmark3D landmark;
        landmark.z << flat.landmarks[static_cast<std::size_t>(i)].z, pitch(random);
        result.landmarks.push_back(landmark);
        for (Eigen::Index j = 0; j < count; ++j) {
            result.predictionCovariance.block<2, 2>(3 * i, 3 * j) =
                flat.predictionCovariance.block<2, 2>(2 * i, 2 * j);
            result.predictionCovariance(3 * i + 2, 3 * j + 2) = 0.04;  // an error of all
        }
    }
    Eigen::MatrixXd mixing = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    for (Eigen::Index i = 0; i < 3 * count; ++i)
        for (Eigen::Index j = std::max<Eigen::Index>(0, i - 4); j <= i; ++j)
            mixing(i, j) = 0.05 * unit(random);
    result.predictionCovariance += mixing * mixing.transpose();
    const double common = 0.2 * unit(random);
    for (std::size_t i = 0; i < flat.measurements.size(); ++i) {
        TMeasurement3D measurement;
        const double seenPitch =
            i < result.landmarks.size() ? result.landmarks[i].z[2] + common : pitch(random);
        measurement.z << flat.measurements[i].z, seenPitch + 0.1 * unit(random);
        measurement.R *= 0.01;
        measurement.R.topLeftCorner<2, 2>() = flat.measurements[i].R;
        measurement.R(2, 0) = measurement.R(0, 2) = 0.003 * std::tanh(unit(random));
        result.measurements.push_back(measurement);
    }
    return result;
}

}  // namespace salma::association::test
