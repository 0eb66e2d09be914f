// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/CSlamBackend.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace salma::bench {

/// Noise of the odometry: the drift of the position after one lap is below, at and four times the
/// distance of two doors, 2.5 m.
struct TNoiseLevel {
    std::string name;
    double headingPerMetre{0};   //!< Standard deviation after one metre [rad].
    double positionPerMetre{0};  //!< Along and across, each, after one metre [m].
};
std::vector<TNoiseLevel> noiseLevels();

/// A drive, and what is true of it.
struct TDrive {
    std::vector<slam::TStepInput> steps;
    std::vector<Eigen::Vector3d> truth;  //!< Pose after each step (x, y, heading) [m, rad].
    Eigen::Vector3d odometryAtClosure;   //!< Pose by odometry alone after the first lap.
    std::size_t closure{0};              //!< The step that ends the first lap.
};

/** Laps of a rectangular hallway, 20 m by 10 m, with point landmarks on both walls every 2.5 m.
 *
 * A sensor of range 6 m all around names what it sees, every 0.25 m. All errors are drawn from
 * normal distributions with just the covariances that the steps state. */
class CLoopWorld {
 public:
    explicit CLoopWorld(int laps = 3);

    TDrive drive(const TNoiseLevel& noise, std::uint32_t seed) const;

    std::size_t landmarks() const { return m_landmarks.size(); }
    const Eigen::Vector3d& start() const { return m_poses.front(); }

 private:
    std::size_t m_lap{0};                  //!< Steps of one lap.
    std::vector<Eigen::Vector3d> m_poses;  //!< By step, the start first.
    std::vector<Eigen::Vector2d> m_landmarks;
};

}  // namespace salma::bench
