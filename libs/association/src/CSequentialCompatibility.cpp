// SPDX-License-Identifier: BSD-3-Clause
#include <salma/association/CSequentialCompatibility.h>

#include "nearestPairs.h"

namespace salma::association {

CSequentialCompatibility::CSequentialCompatibility(const TAssociationOptions& options)
    : m_options(options) {
    m_options.validate();
}

TAssociation CSequentialCompatibility::associate(const TAssociationProblem& problem) const {
    CGatedStep step(m_options, problem);
    const std::size_t count = problem.measurements.size();
    std::vector<bool> failed(count, false);
    for (const TGatedPair& near : nearestPairs(step, count)) {
        if (!step.isOpen(near.observation) || failed[near.observation] ||
            step.isTaken(near.pair.landmark))
            continue;
        const auto test = step.joint().test(near.observation, near.pair.landmark);
        if (test && step.passesJointGate(*test)) {
            step.pair(near.observation, near.pair, EReason::nearest);
        } else {
            failed[near.observation] = true;
            ++step.dropped().joint;
        }
    }
    for (std::size_t i = 0; i < count; ++i)
        if (step.isOpen(i))
            step.settle(i, failed[i] ? EReason::jointlyImpossible : EReason::taken, true);
    return step.finish();
}

}  // namespace salma::association
