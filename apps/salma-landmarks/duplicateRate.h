// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "labelledPairs.h"

namespace salma::apps {

struct TDuplicateRate {
    double rate{0};              //!< Of the mixture.
    std::size_t posterPairs{0};  //!< Pairs of places, each counted once over all runs.
    std::size_t prints{0};       //!< Of these, pairs with the same texture, for comparison.
};

/** How often another place looks the same: the share pi of
 *
 *   p(score | another place) = (1 - pi) p(score | other) + pi p(score | same),
 *
 * by expectation-maximisation over the pairs of places, whose textures are not looked at. Each pair
 * of places weighs the same however often it was seen; a prior of half a pair of each kind keeps pi
 * above 0. \param pairs By run. \param ratio p(score|same) / p(score|other) of a pair. */
TDuplicateRate duplicateRate(const std::vector<TLabelledRun>& runs,
                             const std::vector<std::vector<TLabelledPair>>& pairs,
                             const std::function<double(const TLabelledPair&)>& ratio);

}  // namespace salma::apps
