// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>

namespace salma::bench {

struct TStrip {
    std::string log;  //!< CARMEN log whose odometry has been corrected by a SLAM system.
    int first{0};     //!< Scans from this ...
    int count{0};     //!< ... on, so many; 0: all.
    std::string picture;
};

/** Classifies the scans of a real log, with the filter, and draws the classes along the robot's way
 * over the points of the scans.
 * \param out How many scans each class got. \throw std::runtime_error */
void drawStrip(const TStrip& strip, std::ostream& out);

}  // namespace salma::bench
