// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/CDataAssociator.h>

namespace salma::association {

/** Weighs geometry and appearance together and defers what stays ambiguous.
 *
 * Of all hypotheses inside the individual and the joint gate it looks for the one with the largest
 *
 *   L = sum over pairings [ log P_found + log LR + log N(innovation | pairings before it) ]
 *     + sum over unpaired landmarks  log(1 - P_D)
 *     + sum over unpaired measurements  log lambda_new, or log lambda_clutter where a landmark is
 *       so near, given the pairings, that a new one cannot stand there,
 *
 * by branch and bound. LR is 1 for landmarks without appearance. P_found is the
 * probability that a landmark in view is measured, from 0.01 to 0.99, and P_D this times the
 * probability that it is in view: what is paired was in view, whatever was believed before. A
 * measurement is decided as the best hypothesis has it only if no other one within `margin`
 * explains it otherwise. What is left is paired if
 *  - its log LR reaches `acceptLogLr`, or appearance cannot tell,
 *  - it passes both gates given the other pairings that are left, the worst going first,
 *  - geometry predicts it sharply enough: log LR + log N(0) given the pairings made reaches the
 *    density of landmarks that are not in the map. So a robot that is unsure where it is finds
 *    itself by posters first, and by corners when these have told it.
 * Landmarks with log LR <= `forbidLogLr` are no candidates and do not stop a new landmark. Where
 * the search does not end within `searchLimit` tests, pairings are made one by one, the surest
 * first, each against its direct rivals only. Source: own. */
class CSaliencyAssociation : public CDataAssociator {
 public:
    /// \throw std::invalid_argument
    explicit CSaliencyAssociation(const TAssociationOptions& options = {});

    TAssociation associate(const TAssociationProblem& problem) const override;
    TAssociation associate(const TAssociationProblem3D& problem) const override;

 private:
    template <int DIM>
    TAssociation associateIn(const TAssociationProblemOf<DIM>& problem) const;

    TAssociationOptions m_options;
};

}  // namespace salma::association
