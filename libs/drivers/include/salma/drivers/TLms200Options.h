// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/drivers/TGrabberKeys.h>

#include <string>

namespace salma::drivers {

/** A section of a rawlog-grabber ini file for a SICK LMS 200. Keys that MRPT's CSickLaserSerial has
 * keep their names and meaning. */
struct TLms200Options : public config::TStrictOptions<TLms200Options>, public TGrabberKeys {
    TLms200Options() : TGrabberKeys("CLms200", "LASER", 500) {}

    std::string port{"/dev/ttyS0"};
    int baud{38400};                   //!< 9600, 38400 or 500000.
    bool mmMode{false};                //!< Steps of 1 mm up to 32.7 m; else of 1 cm up to 81 m.
    int fieldOfView{180};              //!< 100 or 180 [deg].
    int resolution{50};                //!< Between beams, 50 or 100 [1/100 deg].
    double x{0}, y{0}, z{0};           //!< Of the mirror, in the robot's frame [m].
    double yaw{0}, pitch{0}, roll{0};  //!< [deg], as CSickLaserSerial has them.

    double rangeSigma{0.005};  //!< Noise of a range, without its rounding [m].
    double latency{0};         //!< From the middle of a scan to the first byte of its telegram [s].
    double silence{3};         //!< A laser that sends no scan so long is lost [s].
    double reconnectTime{1};   //!< Between attempts to reach a laser that was lost [s].

    /// Readings of a scan.
    std::size_t beams() const;
    /// Angle between the first and the last of them [rad].
    double aperture() const;
    /// Step of the ranges [m].
    double quantum() const { return mmMode ? 0.001 : 0.01; }

    void visit(config::COptionVisitor& visitor);
    /// \throw std::invalid_argument naming the key.
    void validate() const;
};

}  // namespace salma::drivers
