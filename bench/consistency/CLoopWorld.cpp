// SPDX-License-Identifier: BSD-3-Clause
#include "CLoopWorld.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/rangeBearingModel.h>

#include <cmath>
#include <random>

namespace salma::bench {
namespace {

constexpr double kLength = 20, kWidth = 10;  // of the path's rectangle [m]
constexpr double kHalfHallway = 1.2;         // [m]
constexpr double kDoors = 2.5;               // [m]
constexpr double kStep = 0.25;               // [m]
constexpr int kTurns = 6;                    // steps of a quarter turn on the spot
constexpr double kReach = 6;                 // of the sensor [m]
constexpr double kSigmaRange = 0.05;         // [m]
const double kSigmaBearing = mrpt::DEG2RAD(1.0);

/// Doors on the walls of one side of the rectangle, inside and outside.
void addSide(const Eigen::Vector2d& from,
             double heading,
             double length,
             std::vector<Eigen::Vector2d>& landmarks) {
    const Eigen::Vector2d along(std::cos(heading), std::sin(heading));
    const Eigen::Vector2d left(-along.y(), along.x());
    for (double s = 0.6; s < length; s += kDoors)
        for (const double side : {-kHalfHallway, kHalfHallway})
            landmarks.emplace_back(from + s * along + side * left);
}

/// Covariance of one step, in the frame before it.
Eigen::Matrix3d motionCovariance(const TNoiseLevel& noise, const Eigen::Vector3d& increment) {
    // Turning on the spot counts as a metre for each radian.
    const double travel = increment.head<2>().norm() + std::abs(increment[2]);
    return Eigen::Vector3d(noise.positionPerMetre, noise.positionPerMetre, noise.headingPerMetre)
               .cwiseAbs2()
               .asDiagonal() *
           travel;
}

}  // namespace

std::vector<TNoiseLevel> noiseLevels() {
    return {{"low", mrpt::DEG2RAD(0.5), 0.02},
            {"medium", mrpt::DEG2RAD(1.2), 0.05},
            {"high", mrpt::DEG2RAD(5.0), 0.2}};
}

CLoopWorld::CLoopWorld(int laps) {
    Eigen::Vector3d pose(0, 0, 0);
    m_poses.push_back(pose);
    for (int side = 0; side < 4 * laps; ++side) {
        const double length = side % 2 == 0 ? kLength : kWidth;
        const double heading = side % 4 * M_PI / 2;
        if (side < 4) addSide(pose.head<2>(), heading, length, m_landmarks);
        for (int k = 0; k < std::lround(length / kStep); ++k) {
            pose.head<2>() += kStep * Eigen::Vector2d(std::cos(heading), std::sin(heading));
            m_poses.push_back(pose);
        }
        for (int k = 1; k <= kTurns; ++k) {
            pose[2] = mrpt::math::wrapToPi(heading + k * M_PI / 2 / kTurns);
            m_poses.push_back(pose);
        }
        if (side == 3) m_lap = m_poses.size() - 1;
    }
}

TDrive CLoopWorld::drive(const TNoiseLevel& noise, std::uint32_t seed) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> unit(0, 1);
    TDrive result;
    Eigen::Vector3d odometry = m_poses.front();
    for (std::size_t k = 1; k < m_poses.size(); ++k) {
        const mrpt::poses::CPose2D before(m_poses[k - 1][0], m_poses[k - 1][1], m_poses[k - 1][2]);
        const mrpt::poses::CPose2D now(m_poses[k][0], m_poses[k][1], m_poses[k][2]);
        const auto moved = now - before;
        Eigen::Vector3d increment(moved.x(), moved.y(), moved.phi());
        const Eigen::Matrix3d Q = motionCovariance(noise, increment);
        for (int i = 0; i < 3; ++i) increment[i] += std::sqrt(Q(i, i)) * unit(random);
        slam::TStepInput step;
        step.time = static_cast<double>(k);
        step.increment.mean = mrpt::poses::CPose2D(increment[0], increment[1], increment[2]);
        step.increment.cov = Q;
        for (std::size_t j = 0; j < m_landmarks.size(); ++j) {
            association::TMeasurement m;
            m.z = slam::sighting(m_poses[k], m_landmarks[j]).z;
            if (m.z[0] > kReach) continue;
            m.z[0] += kSigmaRange * unit(random);
            m.z[1] = mrpt::math::wrapToPi(m.z[1] + kSigmaBearing * unit(random));
            m.R = Eigen::Vector2d(kSigmaRange, kSigmaBearing).cwiseAbs2().asDiagonal();
            m.identity = static_cast<int>(j);
            step.measurements.push_back(m);
        }
        odometry = slam::moved(odometry, increment).pose;
        if (k == m_lap) {
            result.odometryAtClosure = odometry;
            result.closure = result.steps.size();
        }
        result.steps.push_back(step);
        result.truth.push_back(m_poses[k]);
    }
    return result;
}

}  // namespace salma::bench
