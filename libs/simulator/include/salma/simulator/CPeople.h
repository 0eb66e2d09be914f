// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CPath.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace salma::simulator {

/// Somebody at one instant.
struct TPerson {
    mrpt::math::TPoint2D place;  //!< [m]
    std::uint64_t clothes{0};    //!< Random bits that colour them.
};

/** Who walks through a world: along the robot's path, either way, each at a speed and a distance
 * aside of their own. Who would come too near to the robot has stepped out of its way. */
class CPeople {
 public:
    CPeople(const TPeopleOptions& options, const CPath& path, std::uint32_t seed);

    /// Those on the robot's floor within 12 m of it. \param time [s after the start]
    std::vector<TPerson> around(double time) const;

    /// True if one of them stands between two points [m]; a point inside a person is hidden too.
    bool hide(const std::vector<TPerson>& people,
              const Eigen::Vector3d& a,
              const Eigen::Vector3d& b) const;

    const TPeopleOptions& options() const { return m_options; }

 private:
    struct TWalker {
        double start, speed, aside;  //!< [m], [m/s] along the path, [m] to the left.
        std::uint64_t clothes;
    };
    TPeopleOptions m_options;
    const CPath& m_path;
    std::vector<TWalker> m_walkers;
};

}  // namespace salma::simulator
