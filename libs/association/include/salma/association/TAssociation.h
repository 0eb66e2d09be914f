// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace salma::association {

enum class EVerdict { paired, created, deferred, clutter };

enum class EReason {
    nearest,            //!< Paired: the best candidate.
    identity,           //!< Paired or new: the log states which landmark it is.
    unexplained,        //!< New: no landmark of the map lies near.
    nearLandmark,       //!< Deferred: too near to a landmark for a new one, too far to be it.
    taken,              //!< Deferred: its candidates went to better measurements.
    jointlyImpossible,  //!< Deferred: no candidate agrees with the other pairings.
    ambiguous,          //!< Deferred: the second-best explanation is nearly as good.
    unsureAppearance,   //!< Deferred: the appearance neither proves nor excludes the candidate.
    improbable,         //!< Deferred: another landmark would explain it as well as the candidate.
    tooMany,            //!< Deferred: the step has more measurements than are looked at.
    notFinite,          //!< Clutter: z or R is not finite.
    badCovariance,      //!< Clutter: R is not positive definite.
    repeatedIdentity,   //!< Clutter: a measurement before it in the step has the same identity.
};

/// What becomes of one measurement.
struct TDecision {
    EVerdict verdict{EVerdict::clutter};
    EReason reason{EReason::notFinite};
    int landmark{-1};  //!< Index into the problem's landmarks; -1 unless paired.
    double distance2{std::numeric_limits<double>::quiet_NaN()};  //!< To it; NaN unless paired.
    double logRatio{std::numeric_limits<double>::quiet_NaN()};   //!< NaN without appearance.
    std::size_t candidates{0};                                   //!< Landmarks inside its gate.
};

/// A landmark that a measurement could be, or that is so near that no new one can stand there.
struct TCandidate {
    std::size_t observation{0};
    std::size_t landmark{0};
    double distance2{0};  //!< Squared Mahalanobis distance, wrapped in the angles.
    double logRatio{std::numeric_limits<double>::quiet_NaN()};  //!< NaN without appearance.
    bool chosen{false};
    bool inGate{true};  //!< False: only within `newDistance2`.
};

/// Pairs (measurement, landmark) that a test excluded, each counted at its first failure.
struct TDropCounts {
    std::size_t invisible{0};
    std::size_t kind{0};       //!< Salient against corner, convex against concave.
    std::size_t identity{0};   //!< The log states another identity.
    std::size_t wallAngle{0};  //!< The walls stand at different angles.
    std::size_t singular{0};   //!< Innovation covariance not finite or not positive definite.
    std::size_t distance{0};   //!< Outside the individual gate.
    std::size_t appearance{0};
    std::size_t joint{0};  //!< Inside the individual gate, outside the joint one.

    TDropCounts& operator+=(const TDropCounts& other);
};

/// What the search for the best hypothesis took; zero for methods that do not search.
struct TSearchCounts {
    std::size_t nodes{0};  //!< Hypotheses that were looked at.
    std::size_t tests{0};  //!< Pairings that were judged given a hypothesis.
    bool complete{true};   //!< False: the limit came first, so a better hypothesis may exist.
};

/// Outcome of one step.
struct TAssociation {
    std::vector<TDecision> decisions;    //!< One per measurement; a landmark occurs at most once.
    std::vector<TCandidate> candidates;  //!< Sorted by observation, then landmark.
    std::size_t pairings{0};
    double jointDistance2{0};  //!< Of all pairings together.
    double logRatio{0};        //!< Sum over the pairings whose appearance was compared.
    /// Log score of the best hypothesis less log(1 - P_D) of all landmarks, a constant [nats];
    /// NaN for methods that have none.
    double score{std::numeric_limits<double>::quiet_NaN()};
    TSearchCounts search;
    TDropCounts dropped;
};

}  // namespace salma::association
