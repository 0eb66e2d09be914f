// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
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

/// As text that people can read and that gives the same string again: "W4.2~0.05 c W1.3~0.6 J1".
/// Value and sigma are left out where they are 0. \throw std::invalid_argument as parsePlaceString.
std::string asText(const TPlaceString& place);

/** The place string that is written in `text`, its letters separated by blanks.
 * \throw std::invalid_argument naming the letter by number and text: another letter than W C c J O
 * X, a number that is none or not finite, a negative sigma, or more after it. */
TPlaceString parsePlaceString(const std::string& text);

}  // namespace salma::observations
