// SPDX-License-Identifier: BSD-3-Clause
#include "TScene.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace salma::bench {
namespace {

constexpr double side = 20;                        // [m]
constexpr double outside = 3;                      // [m], of the robot from the square's corner
constexpr double sigmaRange = 0.05;                // [m]
constexpr double sigmaBearing = 0.5 * M_PI / 180;  // [rad]

Eigen::Vector2d sighting(const Eigen::Vector3d& pose, const Eigen::Vector2d& landmark) {
    const Eigen::Vector2d d = landmark - pose.head<2>();
    return {d.norm(), std::atan2(d[1], d[0]) - pose[2]};
}

/// Derivative of range and bearing by the landmark's place, for a robot with heading 0.
Eigen::Matrix2d byLandmark(const Eigen::Vector3d& pose, const Eigen::Vector2d& landmark) {
    const Eigen::Vector2d d = landmark - pose.head<2>();
    const double range = d.norm();
    Eigen::Matrix2d H;
    H << d[0] / range, d[1] / range, -d[1] / (range * range), d[0] / (range * range);
    return H;
}

}  // namespace

TScene makeScene(const TSceneSize& size, double sigma, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, side);
    std::normal_distribution<double> unit(0, 1);
    const auto noise = [&] { return Eigen::Vector2d(unit(random), unit(random)); };
    const Eigen::Vector3d believed(-outside, -outside, 0);
    const Eigen::Vector3d robot =
        believed + sigma * Eigen::Vector3d(unit(random), unit(random), unit(random) / 20);

    TScene scene;
    auto& problem = scene.problem;
    const auto count = static_cast<Eigen::Index>(size.landmarks);
    Eigen::MatrixXd byPose(2 * count, 3);
    problem.predictionCovariance = Eigen::MatrixXd::Zero(2 * count, 2 * count);
    std::vector<Eigen::Vector2d> places(size.landmarks);
    for (Eigen::Index j = 0; j < count; ++j) {
        auto& truePlace = places[static_cast<std::size_t>(j)];
        truePlace = {place(random), place(random)};
        const Eigen::Vector2d mapped = truePlace + 0.3 * sigma * noise();
        association::TPredictedLandmark landmark;
        landmark.z = sighting(believed, mapped);
        problem.landmarks.push_back(landmark);
        const Eigen::Matrix2d H = byLandmark(believed, mapped);
        byPose.block<2, 2>(2 * j, 0) = -H;
        byPose.block<2, 1>(2 * j, 2) << 0, -1;
        problem.predictionCovariance.block<2, 2>(2 * j, 2 * j) =
            0.09 * sigma * sigma * H * H.transpose();
    }
    const Eigen::Vector3d pose(sigma * sigma, sigma * sigma, sigma * sigma / 400);
    problem.predictionCovariance += byPose * pose.asDiagonal() * byPose.transpose();

    scene.truth.resize(size.landmarks);
    std::iota(scene.truth.begin(), scene.truth.end(), 0);
    std::shuffle(scene.truth.begin(), scene.truth.end(), random);
    scene.truth.resize(size.observations);
    for (const int landmark : scene.truth) {
        association::TMeasurement measurement;
        measurement.R =
            Eigen::Vector2d(sigmaRange * sigmaRange, sigmaBearing * sigmaBearing).asDiagonal();
        measurement.z = sighting(robot, places[static_cast<std::size_t>(landmark)]) +
                        Eigen::Vector2d(sigmaRange, sigmaBearing).cwiseProduct(noise());
        problem.measurements.push_back(measurement);
    }
    return scene;
}

}  // namespace salma::bench
