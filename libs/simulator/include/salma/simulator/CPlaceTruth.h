// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/EPlaceClass.h>
#include <salma/simulator/CBuilding.h>

#include <optional>
#include <vector>

namespace salma::simulator {

/// Where one class of place ends and the next begins.
struct TPlaceRules {
    double maxTurn{M_PI / 9};  //!< The robot looks along an axis of the building within this.
    double near{2};            //!< A junction or dead end at most so far ahead is the place [m].
    double far{3.5};           //!< One farther ahead than this is not yet [m].
    double minBefore{0.2};     //!< A junction's near edge is at least so far ahead [m].
    double behind{0.7};        //!< One whose far edge lies so far behind is over [m].
    double branchDepth{2.5};   //!< A side way at least so deep is a branch [m].
    double flush{0.4};         //!< A corridor that goes on less than this ends there [m].
    double apart{1.5};         //!< Junctions nearer to each other than this are compound [m].
    double cornerAhead{2.5};   //!< The wall ahead in the corner of a room [m].
    double cornerSide{2};      //!< The wall at its side [m].
    double cornerOther{1.5};   //!< The other side's wall is so much farther [m].
    double openAhead{3.5};     //!< In the open nothing is nearer ahead [m].
};

/// Why a pose has no class of its own.
enum class EPlaceDoubt {
    none,
    approach,  //!< A junction or an end is nearer than `far` and farther than `near`.
    inside,    //!< In a junction: its near edge is beside or behind the robot.
    compound,  //!< Two junctions close together, a crossing, or a stub of a corridor.
    across,    //!< The robot does not look along an axis, or looks across a corridor.
    facing,    //!< In a room, looking at a wall between its corners.
    doorway
};

constexpr std::size_t kPlaceDoubts = 7;
const char* asString(EPlaceDoubt doubt);

struct TPlaceTruth {
    std::optional<laser::EPlaceClass> place;  //!< The class, if there is no doubt.
    std::vector<laser::EPlaceClass> either;   //!< On approach: the classes that are both right.
    EPlaceDoubt doubt{EPlaceDoubt::none};
};

/** What kind of place a scanner at `pose` has before it, by the plan of the building alone: doors
 * and furniture do not count. */
TPlaceTruth placeAt(const CBuilding& building,
                    const mrpt::math::TPose2D& pose,
                    const TPlaceRules& rules = {});

}  // namespace salma::simulator
