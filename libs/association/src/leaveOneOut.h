// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CInterpretationTree.h"

namespace salma::association {

struct TLeaveOneOut {
    std::vector<double> distance2;  //!< Of each pairing, given all others.
    double jointDistance2{0};
};

/// Infinite where the joint covariance is not sound.
template <int DIM>
TLeaveOneOut leaveOneOut(const TAssociationProblemOf<DIM>& problem,
                         const std::vector<TBranch>& pairings);

}  // namespace salma::association
