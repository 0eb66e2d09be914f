// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

#include <cmath>

namespace salma::slam {

/// Section [slip] of config.ini: what a wheel that slips makes of odometry, beside its noise.
struct TSlipOptions : public config::TStrictOptions<TSlipOptions> {
    bool use{true};          //!< Explain a step by a slip where odometry cannot (saliency).
    double perMetre{0.05};   //!< Slips per metre of travel.
    double along{0.3};       //!< Sigma of the distance that a slip feigns [m].
    double turn{M_PI / 90};  //!< Sigma of the turn that a slip feigns [rad].

    void visit(config::COptionVisitor& v);
};

}  // namespace salma::slam
