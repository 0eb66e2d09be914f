// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/bits_math.h>
#include <salma/drivers/TLms200Options.h>

#include <stdexcept>

namespace salma::drivers {

std::size_t TLms200Options::beams() const {
    return static_cast<std::size_t>(fieldOfView * 100 / resolution) + 1;
}

double TLms200Options::aperture() const { return mrpt::DEG2RAD(static_cast<double>(fieldOfView)); }

void TLms200Options::visit(config::COptionVisitor& v) {
    using config::anyNumber;
    using config::between;
    const auto turn = between(-180, 180);
    visitGrabberKeys(v, "looks for scans a second; a stamp is late by the time between two");
    v.text("COM_port_LIN", port, "serial port, absolute or below /dev");
    v.choice("COM_baudRate", baud, {{"9600", 9600}, {"38400", 38400}, {"500000", 500000}},
             "rate of the serial port; 500000 needs RS-422");
    // MRPT's examples say 1 and 0
    v.choice("mm_mode", mmMode, {{"1", true}, {"0", false}, {"true", true}, {"false", false}},
             "steps of 1 mm up to 32.7 m, else of 1 cm up to 81 m");
    v.choice("FOV", fieldOfView, {{"100", 100}, {"180", 180}}, "field of view, degrees");
    v.choice("resolution", resolution, {{"50", 50}, {"100", 100}},
             "between two beams, hundredths of a degree");
    v.number("pose_x", x, anyNumber(), "mirror, in the robot's frame, metres");
    v.number("pose_y", y, anyNumber(), "");
    v.number("pose_z", z, anyNumber(), "");
    v.number("pose_yaw", yaw, turn, "degrees");
    v.number("pose_pitch", pitch, turn, "degrees, downwards is positive");
    v.number("pose_roll", roll, turn, "degrees; 180 for a laser that hangs upside down");
    v.number("range_sigma_m", rangeSigma, between(0, 1), "noise of a range");
    v.number("latency_s", latency, between(0, 1),
             "from the middle of a scan to the first byte of its telegram");
    v.number("silence_s", silence, between(0.2, 3600),
             "a laser that sends no scan so long is lost");
    v.number("reconnect_s", reconnectTime, between(0.01, 3600),
             "between attempts to reach a lost laser");
}

void TLms200Options::validate() const {
    checkRanges();
    if (driver != TLms200Options().driver)
        throw std::invalid_argument("driver = '" + driver + "' is not " + TLms200Options().driver);
    if (port.empty()) throw std::invalid_argument("COM_port_LIN is empty");
}

}  // namespace salma::drivers
