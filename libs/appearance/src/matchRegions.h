// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CPatchMatcher.h>
#include <salma/observations/TPatch.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace salma::appearance {

/// How far the second look of two patches agrees.
struct TRegionAgreement {
    double score{0};      //!< Matches over the mean count, in [0, 1].
    double supported{0};  //!< The same of matches that also look alike.
    double tx{0}, ty{0};  //!< Common shift from a to b [m].
    std::vector<std::pair<std::size_t, std::size_t>> pairs;  //!< Index in a, in b; one to one.
};

/** Pairs the salient regions of two patches by place and size.
 *
 * Pairs lie within the chi-square gate of (x, y, log s) after the common shift, nearest first, each
 * region once. A region counts if it is among the `region_strong` most salient share of its patch;
 * its partner may be any region of the other, since the order by saliency changes with the view.
 * The shift is the one on which most pairs agree that also look alike (correlation of what the
 * wall shows around them). If fewer than `region_support` of the regions have such a partner, the
 * shift is not believed, and only pairs that look alike count.
 * \return Empty without regions, or with a pose that is not finite. */
TRegionAgreement matchRegions(const TRegionMatchOptions& options,
                              const observations::TPatch& a,
                              const observations::TPatch& b);

}  // namespace salma::appearance
