// SPDX-License-Identifier: BSD-3-Clause
#include <salma/drivers/TViscaOptions.h>
#include <salma/drivers/viscaPackets.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace salma::drivers {
namespace {

void require(bool good, const std::string& problem) {
    if (!good) throw std::invalid_argument(problem);
}

/// Both ends of an axis must be numbers that a packet can carry.
void checkAxis(const std::string& axis, double min, double max, double countsPerDegree) {
    require(min < max, axis + "_min_deg is not smaller than " + axis + "_max_deg");
    require(std::abs(countsPerDegree) >= 0.01, axis + "_counts_per_deg is too near to 0");
    const double far = mrpt::RAD2DEG(std::max(std::abs(min), std::abs(max)));
    require(far * std::abs(countsPerDegree) <= 0x7FFF,
            axis + "_counts_per_deg times the limits is more than 16 bits hold");
}

}  // namespace

void TViscaOptions::visit(config::COptionVisitor& v) {
    using config::atLeast;
    using config::between;
    using config::moreThan;
    v.integer("baud", baud, between(300, 230400),
              "rate of the serial port; the EVI-D30 knows 9600 only");
    v.integer("address", address, between(1, visca::maxAddress), "place in the chain of cameras");
    v.number("reply_timeout_s", replyTimeout, between(0.02, 10), "longest wait for an answer");
    v.integer("retries", retries, between(0, 100), "repetitions of what was not answered");
    v.number("stall_time_s", stallTime, between(0.1, 60),
             "a head that keeps its place so long has stopped");
    v.number("pan_counts_per_deg", panCounts, between(-1000, 1000),
             "to the left; negative where the camera counts to the right");
    v.number("tilt_counts_per_deg", tiltCounts, between(-1000, 1000),
             "upwards; negative where the camera counts downwards");
    v.degrees("pan_min_deg", panMin, between(-180, 180), "right end");
    v.degrees("pan_max_deg", panMax, between(-180, 180), "left end");
    v.degrees("tilt_min_deg", tiltMin, between(-90, 90), "lower end");
    v.degrees("tilt_max_deg", tiltMax, between(-90, 90), "upper end");
    v.degrees("pan_max_speed_deg", panMaxSpeed, moreThan(0), "per second, at the fastest setting");
    v.degrees("tilt_max_speed_deg", tiltMaxSpeed, moreThan(0),
              "per second, at the fastest setting");
    v.degrees("field_wide_deg", zoom.wideField, config::insideOf(0, 180),
              "horizontal field, not zoomed");
    v.degrees("field_tele_deg", zoom.teleField, config::insideOf(0, 180),
              "horizontal field, fully zoomed");
    v.integer("zoom_max_counts", zoom.maxCounts, between(1, 0xFFFF),
              "position of the zoom when fully zoomed");
    v.numbers("field_table_deg", zoom.tableDegrees, atLeast(0),
              "measured in between: zoom counts, horizontal field, counts, field, ...");
}

void TViscaOptions::validate() const {
    checkRanges();
    checkAxis("pan", panMin, panMax, panCounts);
    checkAxis("tilt", tiltMin, tiltMax, tiltCounts);
    zoom.validate();
}

}  // namespace salma::drivers
