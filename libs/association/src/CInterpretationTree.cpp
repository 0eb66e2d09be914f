// SPDX-License-Identifier: BSD-3-Clause
#include "CInterpretationTree.h"

#include <mrpt/core/exceptions.h>
#include <salma/association/CJointInnovation.h>

#include <cmath>

namespace salma::association {

template <int DIM>
CInterpretationTree<DIM>::CInterpretationTree(const TAssociationProblemOf<DIM>& problem,
                                              const std::vector<TBranch>& branches,
                                              const std::vector<TBranch>& given)
    : m_problem(problem), m_given(branches.size()), m_taken(problem.landmarks.size(), false) {
    m_branches.reserve(branches.size() + given.size());
    for (const TBranch& branch : branches) append(branch);
    for (const TBranch& branch : given) append(branch);
    for (std::size_t i = 0; i < given.size(); ++i) ASSERT_(descend(m_given + i));
    m_root = m_path.size();
    m_nodes = m_tests = 0;
}

template <int DIM>
void CInterpretationTree<DIM>::append(const TBranch& branch) {
    const TMeasurementOf<DIM>& measurement = m_problem.measurements[branch.observation];
    const auto row = static_cast<Eigen::Index>(DIM * branch.landmark);
    TLevel root;
    root.covariance =
        m_problem.predictionCovariance.template block<DIM, DIM>(row, row) + measurement.R;
    root.value = innovation(measurement.z, m_problem.landmarks[branch.landmark].z);
    m_branches.push_back({branch, {root}});
}

template <int DIM>
void CInterpretationTree<DIM>::extend(TState& state) const {
    const std::size_t level = state.levels.size() - 1;
    const TPairing& pairing = m_path[level];
    const TState& other = m_branches[pairing.index];
    const auto row = static_cast<Eigen::Index>(DIM * other.branch.landmark);
    const auto column = static_cast<Eigen::Index>(DIM * state.branch.landmark);
    TReadingCovariance<DIM> cross =
        m_problem.predictionCovariance.template block<DIM, DIM>(row, column);
    for (std::size_t k = 1; k <= level; ++k)
        cross.noalias() -= other.levels[k].coupling.transpose() * state.levels[k].coupling;
    TLevel next;
    next.stamp = pairing.stamp;
    next.coupling = pairing.whitener * cross;
    next.covariance = state.levels.back().covariance;
    next.covariance.noalias() -= next.coupling.transpose() * next.coupling;
    next.value = state.levels.back().value;
    next.value.noalias() -= next.coupling.transpose() * pairing.whitened;
    state.levels.push_back(next);
}

template <int DIM>
const typename CInterpretationTree<DIM>::TLevel& CInterpretationTree<DIM>::current(
    std::size_t index) {
    TState& state = m_branches[index];
    // Stamps are unique: where the last level belongs to the path, all before it do.
    while (state.levels.size() > 1 &&
           (state.levels.size() - 1 > m_path.size() ||
            state.levels.back().stamp != m_path[state.levels.size() - 2].stamp))
        state.levels.pop_back();
    while (state.levels.size() <= m_path.size()) extend(state);
    return state.levels.back();
}

template <int DIM>
TBranchTest CInterpretationTree<DIM>::test(std::size_t index) {
    ++m_tests;
    const TLevel& level = current(index);
    const double infinity = std::numeric_limits<double>::infinity();
    CWhitener<DIM> whitener;
    if (!whitener.set(level.covariance)) return {infinity, -infinity};
    const double distance2 = (whitener * level.value).squaredNorm();
    const double root = whitener.rootOfDeterminant();
    if (!std::isfinite(distance2) || !(root > 0)) return {infinity, -infinity};
    return {distance2, -std::log(gaussNorm<DIM>() * root)};
}

template <int DIM>
bool CInterpretationTree<DIM>::descend(std::size_t index) {
    const TBranchTest tested = test(index);
    if (!std::isfinite(tested.distance2)) return false;
    const TLevel& level = m_branches[index].levels.back();
    TPairing pairing;
    pairing.index = index;
    pairing.stamp = ++m_stamp;
    ASSERT_(pairing.whitener.set(level.covariance));  // as the test found
    pairing.whitened = pairing.whitener * level.value;
    pairing.distance2 = distanceAt(m_path.size()) + tested.distance2;
    m_path.push_back(pairing);
    m_taken[m_branches[index].branch.landmark] = true;
    ++m_nodes;
    return true;
}

template <int DIM>
void CInterpretationTree<DIM>::ascend() {
    m_taken[m_branches[m_path.back().index].branch.landmark] = false;
    m_path.pop_back();
}

template class CInterpretationTree<2>;
template class CInterpretationTree<3>;

}  // namespace salma::association
