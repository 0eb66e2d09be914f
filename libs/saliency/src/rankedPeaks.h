// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/TSalientRegion.h>

#include <cstddef>
#include <vector>

namespace salma::saliency {

/// Stands for a peak in sorting, a third of its size.
struct TRankedPeak {
    double Y{0};
    std::size_t index{0};
};

/** Peaks whose W exceeds `wMin`, in their order.
 * \throw std::invalid_argument if a position, scale or Y is not finite, or beyond 1e9 px. */
std::vector<TRankedPeak> rankedPeaks(const std::vector<observations::TSalientRegion>& peaks,
                                     double wMin);

/// Smallest upright box [px].
struct TBox {
    double left{0};
    double top{0};
    double right{0};
    double bottom{0};
};

/// Around the centres of the ranked peaks, which are some.
TBox boxOf(const std::vector<TRankedPeak>& ranked,
           const std::vector<observations::TSalientRegion>& peaks);

/// Sorts the more salient first; equal ones by row, column, scale.
void sortBySalience(std::vector<TRankedPeak>& ranked,
                    const std::vector<observations::TSalientRegion>& peaks);

}  // namespace salma::saliency
