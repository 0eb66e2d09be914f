// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose2D.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace salma::observations {

/// One FLASER line.
struct TCarmenScan {
    /// Label "FLASER", stamp of the first of the line's two clocks, 180 deg wide.
    mrpt::obs::CObservation2DRangeScan::Ptr scan;
    mrpt::poses::CPose2D odometry;  //!< T_o_r: the last three numbers before the stamps.
    /// The stamp as the log has it, often since the robot's start [s]. MRPT's clock, in which the
    /// scan has it too, cannot be asked for seconds before 1970.
    double time{0};
    std::size_t line{0};  //!< In the file, from 1.
};

/// What a CARMEN log holds for a laser.
struct TCarmenLog {
    std::string file;
    std::vector<TCarmenScan> scans;  //!< In the order of the file, which counts.
    /// Messages that were not used, by name: comments ("#"), ODOM, PARAM, ...
    std::map<std::string, std::size_t> skipped;
    std::size_t backwards{0};  //!< Scans with an earlier stamp than the one before.
};

struct TCarmenOptions {
    /// Readings this long or longer mean that nothing came back [m]. A smaller
    /// `robot_front_laser_max` of the log itself counts.
    double maxRange{50};
};

/** Reads the front laser of a CARMEN text log: plain, gzip or bzip2, told by its first bytes.
 *
 * `FLASER n ranges... x y theta odom_x odom_y odom_theta stamp host stamp`, ranges from right to
 * left in metres. An odd number of readings spans -90..+90 deg; an even one, as old logs have it,
 * lacks the last (180 readings: -90..+89 deg), and as MRPT centres every scan the scanner's pose is
 * then turned by half a step. The scanner stands `robot_frontlaser_offset` ahead of the robot's
 * origin if the log says so.
 *
 * MRPT's carmen_log_parse_line() is not used: it takes 180 readings for 90 deg, reads over a wrong
 * number of readings, and keeps PARAM values from one file to the next (seen with 2.5.8).
 * \throw std::runtime_error one line, naming the file, the line and what is wrong: missing or
 * damaged file, a line that breaks off, a wrong count, a number that is none, not finite or out of
 * range, no FLASER line at all.
 * Source: the comment at the head of such logs; the spans as in GMapping's reader. */
TCarmenLog readCarmenLog(const std::string& file, const TCarmenOptions& options = {});

}  // namespace salma::observations
