// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CPath.h>
#include <salma/simulator/CWorld.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace salma::simulator {

/** Where the pan/tilt head looks during a whole run, and when it takes pictures.
 *
 * The head turns at constant speed, stops, and takes its picture at rest. */
class CHeadPlan {
 public:
    /// What is around the robot at some time [s after the start].
    using WorldAt = std::function<const CWorld&(double)>;

    CHeadPlan(const THeadOptions& options,
              const CPath& path,
              const WorldAt& world,
              std::uint32_t seed);

    /// Where nothing changes. \param world Used here only.
    CHeadPlan(const THeadOptions& options,
              const CPath& path,
              const CWorld& world,
              std::uint32_t seed);

    /// Pan angle, left is positive [rad]; the ends are held.
    double pan(double time) const;

    /// When pictures are taken [s after the start], increasing.
    const std::vector<double>& pictureTimes() const { return m_pictureTimes; }

 private:
    struct TKnot {
        double time, pan;
    };
    double nextStop();
    /// Pan towards the nearest poster that can be seen from where the robot is at `time`.
    std::optional<double> nearestPoster(const CPath& path, const CWorld& world, double time) const;
    std::optional<double> target(const CPath& path,
                                 const WorldAt& world,
                                 double time,
                                 double pan) const;

    THeadOptions m_options;
    std::vector<TKnot> m_knots;
    std::vector<double> m_pictureTimes;
    std::size_t m_stop{0};
    bool m_forth{true};
};

}  // namespace salma::simulator
