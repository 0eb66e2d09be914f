// SPDX-License-Identifier: BSD-3-Clause
#include <salma/association/CNearestNeighbour.h>

#include "nearestPairs.h"

namespace salma::association {

CNearestNeighbour::CNearestNeighbour(const TAssociationOptions& options) : m_options(options) {
    m_options.validate();
}

template <int DIM>
TAssociation CNearestNeighbour::associateIn(const TAssociationProblemOf<DIM>& problem) const {
    CGatedStep step(m_options, problem);
    const std::size_t count = problem.measurements.size();
    for (const TGatedPair& near : nearestPairs(step, count))
        if (step.isOpen(near.observation) && !step.isTaken(near.pair.landmark))
            step.pair(near.observation, near.pair.landmark, EReason::nearest);
    for (std::size_t i = 0; i < count; ++i)
        if (step.isOpen(i)) step.settle(i, EReason::taken, false);
    return step.finish();
}

TAssociation CNearestNeighbour::associate(const TAssociationProblem& problem) const {
    return associateIn(problem);
}

TAssociation CNearestNeighbour::associate(const TAssociationProblem3D& problem) const {
    return associateIn(problem);
}

}  // namespace salma::association
