// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <salma/config/TStrictOptions.h>
#include <salma/drivers/TLms200Options.h>

#include <string>

namespace salma::drivers {

/** A section of a rawlog-grabber ini file for a LMS 200 on a mount that nods: the laser's keys
 * (`pose_` is where the mount's axis is, at elevation 0) and those of the mount. */
struct TNoddingLaserOptions : public config::TStrictOptions<TNoddingLaserOptions> {
    TNoddingLaserOptions();

    TLms200Options laser;
    std::string mountPort{"/dev/ttyS1"};
    int mountBaud{115200};
    double mountLatency{0};         //!< From the reading of the angle to the first byte [s].
    double mirrorX{0}, mirrorZ{0};  //!< Mirror before and above the axis, at elevation 0 [m].
    double maxGap{0.2};             //!< Between two angles that are interpolated [s].
    double minSweep{mrpt::DEG2RAD(30.0)};  //!< Smaller sweeps are dropped [rad].
    bool writeScans{false};                //!< Also as CObservation2DRangeScan.

    void visit(config::COptionVisitor& visitor);
    /// \throw std::invalid_argument naming the key.
    void validate() const;
};

}  // namespace salma::drivers
