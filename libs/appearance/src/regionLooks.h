// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/TPatch.h>

#include <array>
#include <vector>

namespace salma::appearance {

/// What a wall shows around a region: grey levels on a grid, mean 0 and norm 1; all 0 if even.
using RegionLook = std::array<float, 64>;

/** The surroundings of each region of a patch, 1.2 radii or 7 cm to each side, in one softness for
 * all patches. Beyond the patch's edge its last pixels are repeated; empty without a picture. */
std::vector<RegionLook> regionLooks(const observations::TPatch& patch);

/// In [-1, 1].
double correlation(const RegionLook& a, const RegionLook& b);

}  // namespace salma::appearance
