// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "CLoopWorld.h"

namespace salma::bench {

/// Average over the runs of one filter at one level of noise.
struct TConsistency {
    std::string filter;
    /// Normalised squared error of the pose, e' P^-1 e, by step; 3 for a consistent filter.
    std::vector<double> nees;
    double meanNees{0};     //!< Over all steps.
    double shareInside{0};  //!< Of the steps, inside the interval.
    double positionRms{0};  //!< Over all steps and runs [m].
};

/// One level of noise.
struct TLevelResult {
    TNoiseLevel level;
    std::size_t runs{0};
    double low{0}, high{0};    //!< 95 % interval of the average NEES of so many runs.
    double driftAtClosure{0};  //!< Of odometry alone, RMS of the position after one lap [m].
    std::vector<TConsistency> filters;
};

/// Runs every filter over the same drives, of seeds `seed`, `seed` + 1, ...
/// \throw std::invalid_argument without runs.
TLevelResult study(const CLoopWorld& world,
                   const TNoiseLevel& level,
                   std::size_t runs,
                   std::uint32_t seed);

/// NEES over time with its interval, one panel for each level. \throw std::runtime_error
void plotConsistency(const std::vector<TLevelResult>& levels, const std::string& file);

}  // namespace salma::bench
