// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace salma::drivers {

/** What a zoom lens shows at a position of its zoom motor.
 *
 * Model: every step of the motor lengthens the focal length by the same factor, so that its
 * logarithm is linear between the two ends. The ends are Sony's figures; how the lens runs between
 * them is not published, so a picture taken there wants its own calibration. Source: own. */
struct TZoomModel {
    double wideField{0};   //!< Horizontal field of view at 0 counts [rad].
    double teleField{0};   //!< At `maxCounts` [rad]; smaller.
    int maxCounts{0x3FF};  //!< Larger than 0.

    /// Focal length over the shortest one [-]: 1 at 0 counts; counts beyond the ends count as ends.
    double factor(int counts) const;
    double maxFactor() const { return factor(maxCounts); }
    /// Nearest position for a focal length in [1, maxFactor()].
    int counts(double factor) const;
    /// Horizontal field of view [rad].
    double field(double factor) const;
};

}  // namespace salma::drivers
