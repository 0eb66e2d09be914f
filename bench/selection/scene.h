// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/TWorld.h>

#include <cstddef>
#include <string>
#include <vector>

namespace salma::bench {

/// A picture on a wall.
struct THanging {
    std::string texture;  //!< File.
    std::string wall;     //!< Built-in texture of the simulator.
    double width{0};      //!< With its frame [m].
    double height{0};     //!< [m]
    double frame{0};      //!< Width of its dark frame [m]; 0: none.
};

/** Picture number `index` of a set: the four walls in turn, heights of 0.5 to 0.8 m, every other
 * one with a frame of 15 mm. \throw std::runtime_error if the file cannot be read. */
THanging hangingOf(const std::string& texture, std::size_t index);

/** A hall of 16 x 9 m. The picture hangs in the middle of the wall y = 0, which has doors to both
 * sides, 0.6 m from it at least, and a heater below. \param hung False: the wall stays bare. */
simulator::TWorld hallWith(const THanging& hanging, bool hung);

/// Names of the pictures of a set, as files. \throw std::invalid_argument
std::vector<std::string> filesOf(const std::string& set);

}  // namespace salma::bench
