// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

namespace salma::association {

enum class EMethod { nn, scnn, jcbb, saliency };

/// Section [association] of config.ini.
struct TAssociationOptions : public config::TStrictOptions<TAssociationOptions> {
    EMethod method{EMethod::saliency};
    double gateQuantile{0.99};   //!< Probability that a true pairing passes the individual gate.
    double jointQuantile{0.99};  //!< The same for all pairings of a step together.
    double newDistance2{30};  //!< A new landmark is at least so far from all others, squared [-].
    double wallAngleQuantile{0.99};  //!< Probability that the right wall passes.
    double acceptLogLr{0};           //!< Appearance proves a candidate from here on.
    double forbidLogLr{-2};          //!< Appearance excludes a candidate up to here.
    double margin{3};                //!< Least lead over the second-best hypothesis [nats].
    /// Log densities of landmarks that are not in the map [1/(m rad)]; log LR + log N(0) of a
    /// pairing must reach them.
    double cornerLogDensity{2};
    double salientLogDensity{-3};
    /// Log densities of measurements of nothing [1/(m rad)]. Above the densities of new landmarks
    /// less half the gate less the margin they would be a hidden gate, narrower than the stated
    /// one.
    double cornerClutterLogDensity{-6};
    double salientClutterLogDensity{-11};
    double detectionProbability{0.5};  //!< Of landmarks of which the problem states none.
    int searchLimit{50000};            //!< Tests of joint compatibility in one search.
    int seed{1};                       //!< Of the random starts after that.
    int maxMeasurements{200};          //!< Of a step; those farther away are deferred.

    void visit(config::COptionVisitor& v);
    /// \throw std::invalid_argument
    void validate() const;
};

}  // namespace salma::association
