// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <salma/config/TStrictOptions.h>
#include <salma/drivers/TZoomModel.h>

namespace salma::drivers {

/** A pan/tilt camera that speaks VISCA; the defaults are those of Sony's EVI-D30.
 *
 * Sources: limits and field of view, Ho (2004), 4.4.2 (48.8 deg also Sony); counts per degree
 * (0x370 = 880 for 100 deg, 0x12C = 300 for 25 deg), zoom counts and speeds, Sony, "EVI-D100
 * Technical Manual" and "EVI-D70 Technical Manual", chapter "D30/D31 mode". That positive pan is to
 * the left is Ho's (035D "left", FCA4 "right"); Sony's manual says right, for its own view. So the
 * sign is an option: check it once. */
struct TViscaOptions : public config::TStrictOptions<TViscaOptions> {
    int baud{9600};
    int address{1};            //!< Place in the chain of cameras, 1 .. 7.
    double replyTimeout{0.2};  //!< Longest wait for an answer [s].
    int retries{3};            //!< Repetitions of what was not answered or was refused for now.
    double stallTime{1};       //!< A head that keeps its place so long has stopped [s].
    double panCounts{8.8};     //!< Per degree to the left; negative: counts grow to the right.
    double tiltCounts{12};     //!< Per degree upwards; negative: counts grow downwards.
    double panMin{mrpt::DEG2RAD(-100.0)}, panMax{mrpt::DEG2RAD(100.0)};  //!< [rad]
    double tiltMin{mrpt::DEG2RAD(-25.0)}, tiltMax{mrpt::DEG2RAD(25.0)};  //!< [rad]
    double panMaxSpeed{mrpt::DEG2RAD(80.0)};   //!< Of speed byte 18 (hexadecimal) [rad/s].
    double tiltMaxSpeed{mrpt::DEG2RAD(50.0)};  //!< Of speed byte 14 (hexadecimal) [rad/s].
    TZoomModel zoom{mrpt::DEG2RAD(48.8), mrpt::DEG2RAD(4.4), 0x3FF, {}};

    void visit(config::COptionVisitor& visitor);
    /// \throw std::invalid_argument naming the key.
    void validate() const;
};

}  // namespace salma::drivers
