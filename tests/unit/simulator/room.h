// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/TWorld.h>

#include <string>

#include "CTemporaryFolder.h"

namespace salma::simulator {

/** A room of 6 m x 3 m, x from -2 to 4 and y from -1.5 to 1.5, ceiling at 2.6 m, with doors and
 * posters nowhere; the robot drives 1.2 m forward from the origin. */
inline std::string roomIni(const std::string& more = {}) {
    return "[path]\npoints_m = 0 0 1.2 0\nclosed = false\nlaps = 1\n"
           "[wall_south]\nfrom_m = 4 -1.5\nto_m = -2 -1.5\n"
           "[wall_east]\nfrom_m = 4 1.5\nto_m = 4 -1.5\n"
           "[wall_north]\nfrom_m = -2 1.5\nto_m = 4 1.5\n"
           "[wall_west]\nfrom_m = -2 -1.5\nto_m = -2 1.5\n" +
           more;
}

/// The room with a poster of the built-in marker on its east wall, straight ahead of the origin.
inline std::string markerIni() {
    return roomIni(
        "[poster_m]\nwall = east\nat_m = 1.2\ncentre_height_m = 1.5\nwidth_m = 0.6\n"
        "height_m = 0.6\nborder_m = 0\ntexture = marker\n");
}

inline TWorld load(const test::CTemporaryFolder& folder, const std::string& ini) {
    return loadWorld(folder.write("room.ini", ini));
}

}  // namespace salma::simulator
