// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

#include <vector>

namespace salma::slam {

/** Section [detection] of config.ini: how often a poster or corner that is looked at is found.
 *
 * The probability of a poster is the product of two tables, that of a corner a third, all
 * interpolated and constant beyond their ends. They are set by hand; `salma-landmarks calibrate`
 * learns others: share/detection.ini. */
struct TDetectionOptions : public config::TStrictOptions<TDetectionOptions> {
    std::vector<double> incidence{0, 15, 30, 45, 60, 75, 90};  //!< Ascending [deg].
    std::vector<double> byIncidence{0.6, 0.6, 0.55, 0.5, 0.4, 0.2, 0.02};
    std::vector<double> range{0, 1.5, 2.5, 3.5, 5, 7, 10};  //!< Ascending [m].
    std::vector<double> byRange{0.5, 0.8, 1, 1, 0.8, 0.4, 0.1};
    std::vector<double> cornerRange{0, 10};  //!< Ascending [m].
    std::vector<double> byCornerRange{0.5, 0.5};

    void visit(config::COptionVisitor& v);
    /// \throw std::invalid_argument
    void validate() const;

    /// Of a poster. \param angle Between the ray and the wall's normal [rad]. \param distance [m]
    double probability(double angle, double distance) const;
    /// Of a corner. \param distance [m]
    double cornerProbability(double distance) const;
};

}  // namespace salma::slam
