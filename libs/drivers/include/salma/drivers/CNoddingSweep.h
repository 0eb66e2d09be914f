// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace salma::drivers {

/// Elevation of a mount over time, interpolated linearly.
class CElevationHistory {
 public:
    /// \param elevation Upwards is positive [rad]. A stamp that is not later than the last (the
    /// clock was set back) starts the history anew.
    void add(double time, double elevation);
    /** Nothing outside the history, or between two entries more than `maxGap` [s] apart. */
    std::optional<double> at(double time, double maxGap) const;
    /// Stamp of the newest entry [s]; nothing if there is none.
    std::optional<double> end() const;

 private:
    std::map<double, double> m_elevations;  //!< The last ten seconds.
};

/// A scan whose place is known.
struct TPlacedScan {
    mrpt::obs::CObservation2DRangeScan::Ptr scan;  //!< Its pose is that of its middle beam's time.
    double elevation{0};                           //!< At that time [rad].
    std::vector<mrpt::math::TPoint3Df> points;     //!< Each beam at its own time, robot frame.
};

/** Cuts a stream of placed scans where the mount turns round.
 *
 * A sweep ends at the highest or lowest scan once the mount has come back from there by one degree:
 * noise of the angle cuts nothing. It also ends after `maxScans`, should the mount stand still. */
class CNoddingSweep {
 public:
    static constexpr std::size_t maxScans = 3000;

    /// The sweep that `scan` showed to be over, if so.
    std::vector<TPlacedScan> add(TPlacedScan scan);
    void clear();

 private:
    std::vector<TPlacedScan> m_scans;
    int m_direction{0};        //!< 1 up, -1 down, 0 not known yet.
    std::size_t m_extreme{0};  //!< Of m_scans, the farthest in that direction.
};

}  // namespace salma::drivers
