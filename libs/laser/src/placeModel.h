// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/CPlaceFilter.h>

#include <vector>

namespace salma::laser {

/// Sizes of the layers: features, hidden ones, classes.
extern const std::vector<int> kPlaceLayers;

/// All layers of TPlaceNetwork, each by columns.
extern const std::vector<float> kPlaceWeights;

/// Of shippedPlaceTransitions().
extern const TPlaceMatrix kPlaceGoingOn, kPlaceTurning;

}  // namespace salma::laser
