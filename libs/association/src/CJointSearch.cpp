// SPDX-License-Identifier: BSD-3-Clause
#include "CJointSearch.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace salma::association {
namespace {

constexpr std::size_t startingPairings = 4;     // of a random hypothesis, as in Paz et al.
constexpr double failureProbability = 1e-3;     // of never drawing a right start
constexpr std::size_t maxRandomStarts = 10000;  // the limit of tests comes first
constexpr std::size_t testsPerStart = 2000;

}  // namespace

template <int DIM>
CJointSearch<DIM>::CJointSearch(CInterpretationTree<DIM>& tree, const CChiSquareGate& gate)
    : m_tree(tree), m_gate(gate) {
    std::size_t landmarks = 0;
    for (std::size_t i = 0; i < tree.size(); ++i)
        landmarks = std::max(landmarks, tree[i].landmark + 1);
    m_lastSeen.assign(landmarks, 0);
}

template <int DIM>
typename CJointSearch<DIM>::TFront CJointSearch<DIM>::rootFront() const {
    TFront front;
    for (std::size_t i = 0; i < m_tree.size(); ++i) {
        if (i == 0 || m_tree[i].observation != m_tree[i - 1].observation) front.emplace_back();
        front.back().push_back({i, 0});
    }
    return front;
}

template <int DIM>
typename CJointSearch<DIM>::TFront CJointSearch<DIM>::tested(const TFront& front) {
    // No hypothesis below has more pairings, so none has a larger gate; distances only grow.
    const double room = m_gate(m_tree.depth() + front.size()) - m_tree.distance2();
    TFront result;
    result.reserve(front.size());
    for (const auto& survivors : front) {
        std::vector<TSurvivor> left;
        for (const TSurvivor& survivor : survivors) {
            if (m_tree.isTaken(m_tree[survivor.branch].landmark)) continue;
            const double distance2 = m_tree.test(survivor.branch).distance2;
            if (distance2 <= room) left.push_back({survivor.branch, distance2});
        }
        if (left.empty()) continue;
        std::sort(left.begin(), left.end(), [](const TSurvivor& a, const TSurvivor& b) {
            return std::tie(a.distance2, a.branch) < std::tie(b.distance2, b.branch);
        });
        result.push_back(std::move(left));
    }
    return result;
}

template <int DIM>
std::size_t CJointSearch<DIM>::bound(const TFront& front) {
    ++m_looks;
    std::size_t landmarks = 0;
    for (const auto& survivors : front)
        for (const TSurvivor& survivor : survivors) {
            std::size_t& look = m_lastSeen[m_tree[survivor.branch].landmark];
            landmarks += look != m_looks;
            look = m_looks;
        }
    return m_tree.depth() + std::min(front.size(), landmarks);
}

template <int DIM>
bool CJointSearch<DIM>::promises(const TFront& front, std::size_t bound) const {
    if (front.empty() || bound < m_best.branches.size()) return false;
    double distance2 = m_tree.distance2();
    if (bound == m_tree.depth() + front.size() && bound == m_best.branches.size()) {
        // To draw level, every observation must be paired: also the one that lies farthest.
        double farthest = 0;
        for (const auto& survivors : front)
            farthest = std::max(farthest, survivors.front().distance2);
        distance2 += farthest;
    }
    return distance2 <= m_gate(bound) &&
           (bound > m_best.branches.size() || distance2 < m_best.distance2);
}

template <int DIM>
void CJointSearch<DIM>::consider() {
    const std::size_t pairings = m_path.size();
    const double distance2 = m_tree.distance2();
    const std::size_t most = m_best.branches.size();
    if (!(distance2 <= m_gate(pairings)) || pairings < most ||
        (pairings == most && !(distance2 < m_best.distance2)))
        return;
    m_best = {m_path, distance2};
}

template <int DIM>
void CJointSearch<DIM>::explore(TFront front) {
    while (promises(front, bound(front)) && m_tree.tests() < m_lastTest) {
        // The least ambiguous observation first: its pairing tells most about the others.
        const auto next = std::min_element(front.begin(), front.end(), [](auto& a, auto& b) {
            return std::pair(a.size(), a.front().distance2) <
                   std::pair(b.size(), b.front().distance2);
        });
        const std::vector<TSurvivor> survivors = std::move(*next);
        front.erase(next);
        for (const TSurvivor& survivor : survivors) {
            if (m_tree.tests() >= m_lastTest) return;
            if (!m_tree.descend(survivor.branch)) continue;
            m_path.push_back(survivor.branch);
            consider();
            explore(tested(front));
            ascendTo(m_path.size() - 1);
        }
        // And around again: hypotheses that leave this observation out.
    }
}

template <int DIM>
bool CJointSearch<DIM>::branchAndBound(std::size_t tests) {
    m_lastTest = m_tree.tests() + tests;
    explore(tested(rootFront()));
    return m_tree.tests() < m_lastTest;
}

template <int DIM>
void CJointSearch<DIM>::ascendTo(std::size_t depth) {
    for (; m_path.size() > depth; m_path.pop_back()) m_tree.ascend();
}

template <int DIM>
TJointHypothesis CJointSearch<DIM>::bestOf(const TFront& few, std::size_t tests) {
    const TJointHypothesis before = std::exchange(m_best, {});
    m_lastTest = m_tree.tests() + tests;
    explore(tested(few));
    return std::exchange(m_best, before);
}

template <int DIM>
void CJointSearch<DIM>::addNearest(const std::vector<TSurvivor>& survivors) {
    TSurvivor nearest{0, m_gate(m_tree.depth() + 1) - m_tree.distance2()};
    bool found = false;
    for (const TSurvivor& survivor : survivors) {
        if (m_tree.isTaken(m_tree[survivor.branch].landmark)) continue;
        const double distance2 = m_tree.test(survivor.branch).distance2;
        if (!(distance2 <= nearest.distance2)) continue;
        nearest = {survivor.branch, distance2};
        found = true;
    }
    if (found && m_tree.descend(nearest.branch)) m_path.push_back(nearest.branch);
}

template <int DIM>
void CJointSearch<DIM>::randomised(std::size_t tests, std::uint32_t seed) {
    std::mt19937 random(seed);
    TFront front = rootFront();
    const std::size_t few = std::min(startingPairings, front.size());
    const std::size_t last = m_tree.tests() + tests;
    std::size_t starts = maxRandomStarts;
    for (std::size_t k = 0; k < starts && m_tree.tests() < last; ++k) {
        // std::shuffle is not the same in every standard library.
        for (std::size_t i = front.size(); i > 1; --i) std::swap(front[i - 1], front[random() % i]);
        const auto split = front.begin() + static_cast<std::ptrdiff_t>(few);
        for (const std::size_t branch : bestOf({front.begin(), split}, testsPerStart).branches)
            if (m_tree.descend(branch)) m_path.push_back(branch);
        if (m_path.size() == few)
            for (auto row = split; row != front.end(); ++row) addNearest(*row);
        consider();
        ascendTo(0);
        // Enough starts that one of them had only right pairings, if the best hypothesis is right.
        const double right = std::pow(
            static_cast<double>(m_best.branches.size()) / static_cast<double>(front.size()), few);
        if (right >= 1) break;
        if (right > 0)
            starts = std::min<std::size_t>(
                maxRandomStarts, static_cast<std::size_t>(
                                     std::ceil(std::log(failureProbability) / std::log1p(-right))));
    }
}

template class CJointSearch<2>;
template class CJointSearch<3>;

}  // namespace salma::association
