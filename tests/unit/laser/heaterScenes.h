// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/CPlaneExtractor.h>
#include <salma/simulator/TSensorOptions.h>

#include <cstdint>
#include <vector>

/// A heater before a corridor's wall, seen by a nodding laser.
namespace salma::laser::test {

struct THeaterScene {
    std::vector<mrpt::obs::CObservation2DRangeScan> sweep;
    mrpt::obs::CObservation2DRangeScan level;  //!< What the laser sees when it does not nod.
    /// Robot frame: middle of the heater's front, outward normal of robot's view (into the wall).
    Eigen::Vector2d front, intoWall;
    double depth{0};   //!< Of the heater [m].
    double length{0};  //!< Of the heater [m].
};

/** Scene `seed`: a corridor 1.6 to 3 m wide with door recesses, a heater 0.6 to 1.6 m long, 0.08 to
 * 0.2 m deep and 0.5 to 0.9 m high on one of its walls, and a robot 0.8 to 3 m from its middle that
 * looks within 50 deg of it. */
THeaterScene heaterScene(const simulator::TLaserOptions& laser, std::uint32_t seed);

/// What was made of a scene.
struct THeaterVerdict {
    bool frontFound{false};       //!< A plane lies on the heater's front.
    bool toldFromWall{false};     //!< ... and is a protrusion.
    bool wallFound{false};        //!< The wall behind is found, and as a wall.
    bool otherProtrusion{false};  //!< A protrusion where no heater is.
    bool falseWall2D{false};      //!< The level scan shows a line there, like any wall's.

    bool right() const { return frontFound && toldFromWall && wallFound && !otherProtrusion; }
};

THeaterVerdict judge(const THeaterScene& scene, const TPlaneResult& planes);

}  // namespace salma::laser::test
