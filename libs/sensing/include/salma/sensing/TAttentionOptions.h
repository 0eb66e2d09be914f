// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <salma/config/TStrictOptions.h>

namespace salma::sensing {

/// Keys of CSalientLandmarkSensor about where the head looks. Angles [rad].
struct TAttentionOptions : public config::TStrictOptions<TAttentionOptions> {
    bool use{false};      //!< Entities that are seen are looked at until they are confirmed.
    double patience{20};  //!< One that is not confirmed within this is let go [s].
    double speed{mrpt::DEG2RAD(30.0)};    //!< Of the head [rad/s].
    double deadBand{mrpt::DEG2RAD(1.0)};  //!< Smaller corrections are not made.
    double restPan{0}, restTilt{0};  //!< Where the head looks while nothing is to be confirmed.

    void visit(config::COptionVisitor& visitor);
};

}  // namespace salma::sensing
