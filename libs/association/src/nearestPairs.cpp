// SPDX-License-Identifier: BSD-3-Clause
#include "nearestPairs.h"

#include <algorithm>
#include <tuple>

namespace salma::association {

template <int DIM>
std::vector<TGatedPair> nearestPairs(const CGatedStep<DIM>& step, std::size_t observations) {
    std::vector<TGatedPair> found;
    for (std::size_t i = 0; i < observations; ++i)
        for (const TPair& pair : step.pairs(i))
            if (step.isOpen(i) && pair.inGate) found.push_back({i, pair});
    std::sort(found.begin(), found.end(), [](const TGatedPair& a, const TGatedPair& b) {
        return std::tie(a.pair.distance2, a.observation, a.pair.landmark) <
               std::tie(b.pair.distance2, b.observation, b.pair.landmark);
    });
    return found;
}

template std::vector<TGatedPair> nearestPairs(const CGatedStep<2>&, std::size_t);
template std::vector<TGatedPair> nearestPairs(const CGatedStep<3>&, std::size_t);

}  // namespace salma::association
