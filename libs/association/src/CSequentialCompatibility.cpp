// SPDX-License-Identifier: BSD-3-Clause
#include <salma/association/CSequentialCompatibility.h>

#include <algorithm>
#include <map>

#include "nearestPairs.h"

namespace salma::association {
namespace {

/// Pairs in the order of test: unambiguous measurements first, of each the nearest landmark first.
template <int DIM>
std::vector<TGatedPair> sequence(const CGatedStep<DIM>& step, std::size_t observations) {
    std::vector<TGatedPair> ordered = nearestPairs(step, observations);
    std::map<std::size_t, std::size_t> ofLandmark;
    for (const TGatedPair& near : ordered) ++ofLandmark[near.pair.landmark];
    std::vector<std::size_t> rivals(observations, 0);
    for (const TGatedPair& near : ordered)
        rivals[near.observation] += ofLandmark[near.pair.landmark];
    std::stable_sort(ordered.begin(), ordered.end(), [&](const auto& a, const auto& b) {
        return rivals[a.observation] < rivals[b.observation];
    });
    return ordered;
}

}  // namespace

CSequentialCompatibility::CSequentialCompatibility(const TAssociationOptions& options)
    : m_options(options) {
    m_options.validate();
}

template <int DIM>
TAssociation CSequentialCompatibility::associateIn(
    const TAssociationProblemOf<DIM>& problem) const {
    CGatedStep step(m_options, problem);
    const std::size_t count = problem.measurements.size();
    std::vector<bool> failed(count, false);
    for (const TGatedPair& near : sequence(step, count)) {
        if (!step.isOpen(near.observation) || failed[near.observation] ||
            step.isTaken(near.pair.landmark))
            continue;
        const auto test = step.joint().test(near.observation, near.pair.landmark);
        if (test && step.passesJointGate(*test)) {
            step.pair(near.observation, near.pair.landmark, EReason::nearest);
        } else {
            failed[near.observation] = true;
            ++step.dropped().joint;
        }
    }
    for (std::size_t i = 0; i < count; ++i)
        if (step.isOpen(i))
            step.settle(i, failed[i] ? EReason::jointlyImpossible : EReason::taken, false);
    return step.finish();
}

TAssociation CSequentialCompatibility::associate(const TAssociationProblem& problem) const {
    return associateIn(problem);
}

TAssociation CSequentialCompatibility::associate(const TAssociationProblem3D& problem) const {
    return associateIn(problem);
}

}  // namespace salma::association
