// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/TPatch.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace salma::appearance {

using KeypointPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/** Pairs whose descriptors are each other's nearest, and clearly nearer than the second nearest
 * in both directions. Brute force; distances are exact, so the result is too.
 * \param ratio Nearest over second nearest distance, below 1. A lone keypoint has no second. */
KeypointPairs matchKeypoints(const std::vector<observations::TKeypoint>& a,
                             const std::vector<observations::TKeypoint>& b,
                             double ratio);

}  // namespace salma::appearance
