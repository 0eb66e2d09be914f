// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "CFreePoints.h"

namespace salma::laser {

/// A line and the points that it was found by.
struct TCandidate {
    TFit fit;
    Members members;  //!< In order; empty if there is no further line.
};

/** Where the lines of a scan come from, one by one. What a candidate holds is taken from the free
 * points by the caller: less than all of it where its ends turn out to belong to another wall. */
class CLineSearch {
 public:
    virtual ~CLineSearch() = default;

    /// The next line among the free points, refined; no members if there is none.
    virtual TCandidate next() = 0;
};

/// The method that the options name. \param points Must outlive the search.
std::unique_ptr<CLineSearch> createLineSearch(const TLineOptions& options,
                                              const CFreePoints& points);

/** Fits the line again and gathers its run again until that stays the same.
 * \return False if not half of the points remain. */
void settle(const CFreePoints& points, TCandidate& candidate);

}  // namespace salma::laser
