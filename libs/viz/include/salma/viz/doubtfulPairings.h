// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/TRunRecord.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace salma::viz {

/// A pairing that a run made, and how near it came to being another or none.
struct TDoubtfulPairing {
    std::size_t row{0};  //!< In the record's associations.
    /// Log likelihood by which it was better than its rival, or than a landmark on the edge of
    /// its gate of which nothing is known but the place; below zero: worse.
    double margin{0};
    int rival{-1};  //!< Id of the next best landmark; -1: it was nearer to none at all.
    double rivalDistance2{std::numeric_limits<double>::quiet_NaN()};
    double rivalLogRatio{std::numeric_limits<double>::quiet_NaN()};
};

/** The pairings of salient landmarks with the smallest margins, worst first; equal ones by time.
 *
 * The evidence for a candidate is log LR - d2 / 2, LR = 1 where appearance did not count.
 * \param gate Squared Mahalanobis distance on the edge of the gate. */
std::vector<TDoubtfulPairing> doubtfulPairings(const slam::TRunRecord& record,
                                               std::size_t count = 5,
                                               double gate = 9.21);

}  // namespace salma::viz
