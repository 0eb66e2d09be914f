// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace salma::calibration {

/// One turn of a 2-D laser.
struct TRangeScan {
    double time{0};              //!< [s since 1970]
    double start{0};             //!< Direction of the first range, counter-clockwise from x [rad].
    double step{0};              //!< To the next one [rad]; negative for a clockwise scanner.
    std::vector<double> ranges;  //!< [m]; NaN where nothing came back.

    double direction(std::size_t i) const { return start + static_cast<double>(i) * step; }
};

/** Scans of a text file, one a line: `stamp_s start_rad step_rad end_rad limit count`, then `count`
 * ranges [m]. Numbers are separated by blanks or commas; `inf`, `nan` and `-` mean that nothing
 * came back, as do ranges of 0. `limit` is not used; `end` must lie `count` steps from `start`, or
 * one less.
 *
 * Only the lines `first` to `first + count - 1` are looked at, so that a damaged line elsewhere
 * does no harm. \param first From 1.
 * \throw std::runtime_error naming file, line and value for anything else. */
std::vector<TRangeScan> readScans(const std::string& file, std::size_t first, std::size_t count);

}  // namespace salma::calibration
