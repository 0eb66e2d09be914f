// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CBuilding.h>

#include <cstdint>
#include <ostream>

namespace salma::bench {

/** Distances between the place strings of one pose and of others near it, and of other places.
 * A Markdown table to `out`: quantiles of the distance by what differs. */
void writeStringFigures(const simulator::TBuildingOptions& options,
                        std::uint32_t seed,
                        int buildings,
                        std::ostream& out);

}  // namespace salma::bench
