// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

namespace salma::bench {

constexpr double kPosterHeight = 0.6;  //!< Of the pictures on the walls [m].

/// Walls of the simulator on which they hang, in turn.
constexpr std::array<const char*, 4> kWalls = {"plaster", "brick", "wood", "plain"};

/// Names of the sets of pictures: docs/recognition.md says what was chosen on which.
std::vector<std::string> pictureSetNames();

/** Pictures of a set, as they are named in reports.
 * \throw std::out_of_range for another name. */
const std::vector<std::string>& pictureSet(const std::string& name);

/// Where a picture of a set is; those of Debian's opencv-doc are absolute already.
std::string pictureFile(const std::string& data, const std::string& name);

}  // namespace salma::bench
