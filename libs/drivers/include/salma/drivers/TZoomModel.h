// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace salma::drivers {

/** What a zoom lens shows at a position of its zoom motor.
 *
 * Model: between two known positions every step of the motor lengthens the focal length by the same
 * factor, so that its logarithm is linear. The ends are Sony's figures. How the lens of an EVI-D30
 * runs between them is not published; others of its kind reach a factor of only about 2.5 half
 * way, where two ends alone give 3.4. So measure what matters into `tableDegrees`. Source: own. */
struct TZoomModel {
    double wideField{0};   //!< Horizontal field of view at 0 counts [rad].
    double teleField{0};   //!< At `maxCounts` [rad]; smaller.
    int maxCounts{0x3FF};  //!< Larger than 0.
    /// Measured in between: counts, horizontal field [deg], counts, field, ... (counts rise, fields
    /// fall).
    std::vector<double> tableDegrees;

    /// \throw std::invalid_argument if the table is not as said above, or leaves the ends.
    void validate() const;

    /// Focal length over the shortest one [-]: 1 at 0 counts; counts beyond the ends count as ends.
    double factor(int counts) const;
    double maxFactor() const { return factor(maxCounts); }
    /// Nearest position for a focal length in [1, maxFactor()].
    int counts(double factor) const;
    /// Horizontal field of view [rad].
    double field(double factor) const;

 private:
    struct TKnot {
        double counts;
        double logFactor;
    };
    /// The known positions, both ends included.
    std::vector<TKnot> knots() const;
};

}  // namespace salma::drivers
