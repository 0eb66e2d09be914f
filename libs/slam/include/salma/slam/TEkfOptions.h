// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

#include <cmath>

namespace salma::slam {

/// Who computes the filter step.
enum class EUpdate {
    block,  //!< Own step: every measurement with its own R, symmetric update, O(n^2 m).
    mrpt    //!< The step of MRPT's Kalman filter: the step's mean R for all, dense matrices.
};

/// What the filter estimates.
enum class EState {
    plane,  //!< Pose (x, y, heading) and 2-D landmarks: CSalientEKF2D.
    space   //!< Six degrees of freedom and 3-D landmarks: CSalientEKF3D.
};

/// Section [ekf] of config.ini.
struct TEkfOptions : public config::TStrictOptions<TEkfOptions> {
    EState state{EState::plane};
    EUpdate update{EUpdate::block};  //!< In the plane; in space it is MRPT's.
    bool smooth{true};               //!< At the end path and map are estimated anew (block).
    bool ignoreIdentities{false};    //!< Identities in the log are not read.
    double maxRange{40};             //!< Landmarks farther away are not expected [m].
    double fieldOfView{2 * M_PI};    //!< Centred on straight ahead [rad].
    int minSightingsCorner{3};       //!< Sightings before a corner becomes a landmark.
    double provisionalRadius{0.3};   //!< Sightings of one provisional corner lie within it [m].
    int provisionalSteps{20};        //!< Steps with corners until a provisional one is forgotten.
    int maxPatches{4};               //!< Views of a salient landmark that are kept.
    double patchSpread{M_PI / 12};   //!< Two kept views differ at least so much in incidence [rad].
    /// In one track appearance counts again after this change of the viewing angle [rad].
    double decorrelation{35 * M_PI / 180};
    /// Landmarks that should have been seen go once all missed them by chance with a probability
    /// of exp(-this); 0: never.
    double removeAfter{8};
    double trackGap{10};  //!< A landmark that was not paired for longer begins another track [s].

    void visit(config::COptionVisitor& v);
};

}  // namespace salma::slam
