// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/CDataAssociator.h>

namespace salma::association {

/** Weighs geometry and appearance together and defers what stays ambiguous.
 *
 * The score of a pair is log LR + log N(innovation | pairings before it); landmarks without
 * appearance have LR = 1. The pair with the largest lead over its rivals is made first, and what it
 * tells about the robot's pose sharpens the scores of the others. A rival is another landmark for
 * the measurement, or another measurement for the landmark. A pair is made only if
 *  - it passes the individual and the joint gate, given the pairings before it,
 *  - its log LR reaches `acceptLogLr`, or appearance cannot tell,
 *  - it leads by `margin` over every rival,
 *  - geometry predicts it sharply enough: log LR + log N(0) reaches the density of landmarks that
 *    are not in the map, `cornerLogDensity` or `salientLogDensity`. So a robot that is unsure where
 *    it is finds itself by posters first, and by corners when these have told it.
 * Landmarks with log LR <= `forbidLogLr` are no candidates and do not stop a new landmark.
 * Source: own. */
class CSaliencyAssociation : public CDataAssociator {
 public:
    /// \throw std::invalid_argument
    explicit CSaliencyAssociation(const TAssociationOptions& options = {});

    TAssociation associate(const TAssociationProblem& problem) const override;

 private:
    TAssociationOptions m_options;
};

}  // namespace salma::association
