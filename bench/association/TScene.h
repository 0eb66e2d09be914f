// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationProblem.h>

#include <cstdint>
#include <vector>

namespace salma::bench {

struct TSceneSize {
    std::size_t observations{20};
    std::size_t landmarks{100};
};

/// A problem of association with its solution.
struct TScene {
    association::TAssociationProblem problem;
    std::vector<int> truth;  //!< Landmark of each observation; all are in the map.
};

/** Landmarks all over a square of 20 m by 20 m, seen by a robot 3 m outside of its corner.
 *
 * \param sigma Standard deviation of the robot's x and y [m]; its heading has sigma / 20 [rad],
 * each landmark 0.3 sigma [m] of its own. Measurements have 0.05 m and 0.5 deg. The robot looks
 * inwards, so no bearing comes near the half turn, which MRPT's association does not wrap. */
TScene makeScene(const TSceneSize& size, double sigma, std::uint32_t seed);

}  // namespace salma::bench
