// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CLaserModel.h>

#include <cstdint>
#include <vector>

#include "lineScore.h"

/// Scans of the simulator's LMS 200 with their truth.
namespace salma::laser::test {

struct TTrueScan {
    mrpt::obs::CObservation2DRangeScan scan;
    std::vector<TTrueWall> walls;  //!< Robot frame.
    std::vector<int> hits;         //!< Wall of each reading, -1 for none.
};

/** `count` scans from random places in a random building: in turn a room of 4 to 9 m with cupboards
 * that stand askew, and a corridor with door recesses, a heater and a bend.
 * \param options The laser; `maxOffset` is taken as it is. */
std::vector<TTrueScan> simulatedScans(const simulator::TLaserOptions& options,
                                      std::uint32_t seed,
                                      std::size_t count);

}  // namespace salma::laser::test
