// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

#include <cmath>

namespace salma::slam {

/// Section [relocation] of config.ini.
struct TRelocationOptions : public config::TStrictOptions<TRelocationOptions> {
    bool use{true};            //!< Look for the local map in the map that was left behind.
    double anchorSigma{M_PI};  //!< Heading less sure: state covariances anew [rad].
    double unsure{0.1};  //!< A landmark of the left map predicted less surely is not paired [m].
    double localTravel{25};  //!< Landmarks first seen within so much travel are the local map [m].
    double gap{8};           //!< Between local map and what it is compared with, at least [m].
    double every{0.5};       //!< Travel between two attempts [m].
    double propose{1};       //!< Least score of an alignment that is looked at closely [nats].
    double accept{6.5};      //!< Least score of the best alignment [nats].
    double margin{4};        //!< Least lead over the second-best one [nats].
    double driftFactor{2};   //!< Odometry may err so many times as much as it states.
    double driftOutlier{0.02};  //!< Share of runs in which the pose is lost altogether.
    double overlooked{0.15};    //!< Share of posters in view that a whole pass does not find.
    double geometryCap{2};      //!< Corners alone count so much against "a new place" [nats].
    double pairRadius{0.4};     //!< Landmarks that may be one lie so near after alignment [m].

    void visit(config::COptionVisitor& v);
};

}  // namespace salma::slam
