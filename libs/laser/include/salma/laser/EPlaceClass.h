// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace salma::laser {

/** What kind of place lies before the robot, in the order of all tables and files.
 *
 * A T-junction "left" goes on ahead and to the left, "ahead" ends with a way to either side. An L
 * goes on to one side only. A room corner "left" has its walls ahead and to the left.
 * Source: the classes of K.-L. Ho, transfer report, Oxford 2004, section 4.7, and "open". */
enum class EPlaceClass {
    corridor,
    teeLeft,
    teeRight,
    teeAhead,
    bendLeft,
    bendRight,
    deadEnd,
    cornerLeft,
    cornerRight,
    open
};

constexpr std::size_t kPlaceClasses = 10;

/// A number for each class.
using TPlaceVector = std::array<double, kPlaceClasses>;

/// "corridor", "T left", "T right", "T ahead", "L left", "L right", "dead end", "corner left", ...
const char* asString(EPlaceClass place);

/// The class of that name; nothing for another text.
std::optional<EPlaceClass> placeClassOf(const std::string& name);

/// What the class is called after left and right are exchanged.
EPlaceClass mirrored(EPlaceClass place);

}  // namespace salma::laser
