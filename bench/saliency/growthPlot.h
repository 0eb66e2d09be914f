// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "speedTables.h"

namespace salma::bench {

/** Time against pixels, and cycles for each centre against the largest scale, side by side as a
 * PNG. \param bySize Rows of one largest scale. \param byScale Rows of one size. \throw
 * std::runtime_error if gnuplot is missing or fails, or the file cannot be written. */
void plotGrowth(const std::vector<TSpeedRow>& bySize,
                const std::vector<TSpeedRow>& byScale,
                const std::string& file);

}  // namespace salma::bench
