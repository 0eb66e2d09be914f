// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CGatedStep.h"

namespace salma::association {

struct TGatedPair {
    std::size_t observation;
    TPair pair;
};

/// All pairs inside the individual gate, the nearest first.
template <int DIM>
std::vector<TGatedPair> nearestPairs(const CGatedStep<DIM>& step, std::size_t observations);

}  // namespace salma::association
