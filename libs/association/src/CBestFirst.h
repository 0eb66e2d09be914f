// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>

#include "CGatedStep.h"

namespace salma::association {

/** Decides the open measurements of a step one by one, the surest first.
 *
 * What takes over where the search over hypotheses does not end. A pairing is weighed against its
 * direct rivals only, another landmark for the measurement and another measurement for the
 * landmark, given the pairings made; its lead over each must be the margin. */
template <int DIM>
class CBestFirst {
 public:
    CBestFirst(const TAssociationOptions& options,
               CGatedStep<DIM>& step,
               const TAssociationProblemOf<DIM>& problem);

    void run();

 private:
    /// A pair that passes all gates, given the pairings made so far.
    struct TScored {
        const TPair* pair{nullptr};
        /// log P_found - log(1 - P_D) + log LR + log density [nats].
        double score{-std::numeric_limits<double>::infinity()};
        /// log LR + log density of an innovation of zero: how sharply geometry predicts [nats].
        double peak{-std::numeric_limits<double>::infinity()};
    };
    /// What speaks for the best landmark of a measurement.
    struct TBest {
        std::size_t observation{0};
        TScored best;
        double lead{0};  //!< Over the strongest rival [nats].
    };

    void score();
    /// Best score of a measurement with any landmark but `landmark`; noScore for none.
    double secondBest(std::size_t observation, std::size_t landmark) const;
    TBest best(std::size_t observation) const;
    /// Why the best landmark of a measurement must not be paired; nothing if it may.
    std::optional<EReason> objection(const TBest& candidate) const;
    /// Score of the explanation that a measurement shows a landmark which is not in the map.
    double otherScore(std::size_t observation) const {
        return m_problem.measurements[observation].kind == ELandmarkKind::corner
                   ? m_options.cornerLogDensity
                   : m_options.salientLogDensity;
    }

    const TAssociationOptions& m_options;
    CGatedStep<DIM>& m_step;
    double m_gate;
    const TAssociationProblemOf<DIM>& m_problem;
    std::vector<std::vector<TScored>> m_scores;
};

}  // namespace salma::association
