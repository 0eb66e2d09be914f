// SPDX-License-Identifier: BSD-3-Clause
#include <salma/association/CJointCompatibility.h>

#include "CGatedStep.h"
#include "CJointSearch.h"

namespace salma::association {

CJointCompatibility::CJointCompatibility(const TAssociationOptions& options) : m_options(options) {
    m_options.validate();
}

template <int DIM>
TAssociation CJointCompatibility::associateIn(const TAssociationProblemOf<DIM>& problem) const {
    CGatedStep step(m_options, problem);
    CInterpretationTree tree(problem, step.branches(), step.identityPairings());
    const CChiSquareGate gate(m_options.jointQuantile, DIM, step.openCount());
    CJointSearch search(tree, gate);
    const auto limit = static_cast<std::size_t>(m_options.searchLimit);
    const bool complete = search.branchAndBound(limit);
    if (!complete) search.randomised(limit, static_cast<std::uint32_t>(m_options.seed));
    for (const std::size_t index : search.best().branches)
        step.pair(tree[index].observation, tree[index].landmark, EReason::nearest);
    for (std::size_t i = 0; i < problem.measurements.size(); ++i)
        if (step.isOpen(i)) step.settle(i, step.whyUnpaired(i), true);
    return step.finish({tree.nodes(), tree.tests(), complete});
}

TAssociation CJointCompatibility::associate(const TAssociationProblem& problem) const {
    return associateIn(problem);
}

TAssociation CJointCompatibility::associate(const TAssociationProblem3D& problem) const {
    return associateIn(problem);
}

}  // namespace salma::association
