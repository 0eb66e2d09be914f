// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace salma::observations {

/// One feature of a scan: W wall, C convex corner, c concave corner, J jump edge, O opening, X
/// none.
struct TPlaceLetter {
    char letter{'X'};
    double value{0};  //!< Attribute: length or width [m], or the sign of a jump edge.
    double sigma{0};  //!< Standard deviation of `value`.
};

/// What a scan looks like, read by bearing from right to left. Empty: not described.
using TPlaceString = std::vector<TPlaceLetter>;

}  // namespace salma::observations
