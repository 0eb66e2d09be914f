// SPDX-License-Identifier: BSD-3-Clause
#include <salma/association/CSaliencyAssociation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "CBestFirst.h"
#include "CScoredSearch.h"
#include "leaveOneOut.h"

namespace salma::association {
namespace {

constexpr std::size_t none = TSearchGoal::nothing;

/// Decides the open measurements of one step.
template <int DIM>
class CWeighing {
 public:
    CWeighing(const TAssociationOptions& options,
              const TAssociationProblemOf<DIM>& problem,
              CGatedStep<DIM>& step);

    TAssociation run();

 private:
    void findBest();
    void findDoubts();
    /// By row, the branch that a hypothesis pairs it with.
    std::vector<std::size_t> assignment(const TScoredHypothesis& hypothesis) const;
    void dropOutliers();
    void pairTheSharp();
    void settleTheRest();

    const TAssociationOptions& m_options;
    const TAssociationProblemOf<DIM>& m_problem;
    CGatedStep<DIM>& m_step;
    CInterpretationTree<DIM> m_tree;
    CHypothesisScore<DIM> m_score;
    CChiSquareGate m_gate;
    CScoredSearch<DIM> m_search;
    std::vector<std::size_t> m_rowOf;  //!< By branch.
    TScoredHypothesis m_best;
    std::vector<std::size_t> m_assignment;         //!< Of the best hypothesis.
    std::vector<std::optional<EReason>> m_doubts;  //!< By row, why not to pair it.
    bool m_complete{true};
};

template <int DIM>
CWeighing<DIM>::CWeighing(const TAssociationOptions& options,
                          const TAssociationProblemOf<DIM>& problem,
                          CGatedStep<DIM>& step)
    : m_options(options),
      m_problem(problem),
      m_step(step),
      m_tree(problem, step.branches(true), step.identityPairings()),
      m_score(options, problem, step, step.branches(true)),
      m_gate(options.jointQuantile, DIM, step.openCount()),
      m_search(m_tree, m_score, m_gate, options.newDistance2) {
    std::vector<TExplainable> rows;
    for (std::size_t k = 0; k < m_tree.size(); ++k) {
        if (rows.empty() || rows.back().observation != m_tree[k].observation)
            rows.push_back({m_tree[k].observation, {}, {}});
        rows.back().near.push_back(k);
        if (m_step.pairOf(m_tree[k]).inGate) rows.back().pairable.push_back(k);
        m_rowOf.push_back(rows.size() - 1);
    }
    for (TExplainable& row : rows) m_search.add(std::move(row));
    m_doubts.resize(rows.size());
}

template <int DIM>
std::vector<std::size_t> CWeighing<DIM>::assignment(const TScoredHypothesis& hypothesis) const {
    std::vector<std::size_t> result(m_doubts.size(), none);
    for (const std::size_t branch : hypothesis.branches) result[m_rowOf[branch]] = branch;
    return result;
}

template <int DIM>
void CWeighing<DIM>::findBest() {
    const auto limit = static_cast<std::size_t>(m_options.searchLimit);
    m_best = m_search.find({}, limit);
    m_complete = m_search.isComplete();
    m_assignment = assignment(m_best);
}

/* A measurement is in doubt if a hypothesis that explains it otherwise comes within the margin of
 * the best one. */
template <int DIM>
void CWeighing<DIM>::findDoubts() {
    const std::size_t lastTest = m_tree.tests() + static_cast<std::size_t>(m_options.searchLimit);
    for (std::size_t row = 0; row < m_doubts.size(); ++row) {
        if (m_doubts[row]) continue;
        TSearchGoal goal;
        goal.any = true;
        goal.threshold = m_best.score - m_options.margin;
        if (m_assignment[row] != none)
            goal.withoutBranch = m_assignment[row];
        else if (!m_search.rows()[row].pairable.empty())
            goal.pairedRow = row;
        else
            continue;
        const TScoredHypothesis rival = m_search.find(goal, lastTest);
        if (rival.exists()) {
            const std::vector<std::size_t> other = assignment(rival);
            for (std::size_t k = 0; k < other.size(); ++k)
                if (other[k] != m_assignment[k]) m_doubts[k] = EReason::ambiguous;
        } else if (!m_search.isComplete()) {
            m_complete = false;
        }
    }
}

/* What is in doubt supports nobody, so the rest is judged without it: pairings that do not agree
 * with all others go, the worst first. */
template <int DIM>
void CWeighing<DIM>::dropOutliers() {
    const std::vector<TBranch>& given = m_step.identityPairings();
    const double givenDistance2 = leaveOneOut(m_problem, given).jointDistance2;
    std::vector<std::size_t> kept;
    for (std::size_t row = 0; row < m_doubts.size(); ++row) {
        if (m_assignment[row] == none || m_doubts[row]) continue;
        if (m_step.pairOf(m_tree[m_assignment[row]]).logRatio < m_options.acceptLogLr)
            m_doubts[row] = EReason::unsureAppearance;
        else
            kept.push_back(row);
    }
    while (!kept.empty()) {
        std::vector<TBranch> pairings;
        for (const std::size_t row : kept) pairings.push_back(m_tree[m_assignment[row]]);
        pairings.insert(pairings.end(), given.begin(), given.end());
        const TLeaveOneOut left = leaveOneOut(m_problem, pairings);
        const auto last = left.distance2.begin() + static_cast<std::ptrdiff_t>(kept.size());
        const auto worst = std::max_element(left.distance2.begin(), last);
        if (*worst <= m_gate(1) && left.jointDistance2 - givenDistance2 <= m_gate(kept.size()))
            return;
        const auto position = kept.begin() + (worst - left.distance2.begin());
        m_doubts[*position] = EReason::jointlyImpossible;
        kept.erase(position);
    }
}

/* Geometry must predict a landmark more sharply than landmarks that are not in the map are dense.
 * What it knows grows with each pairing, so this goes on while one more is sharp enough. It is
 * judged by the peak: a limit on the density itself would be a hidden, narrower gate, and a filter
 * that only hears of small innovations becomes too sure of itself. */
template <int DIM>
void CWeighing<DIM>::pairTheSharp() {
    for (bool found = true; found;) {
        found = false;
        for (std::size_t row = 0; row < m_doubts.size(); ++row) {
            if (m_assignment[row] == none || m_doubts[row]) continue;
            const TBranch& branch = m_tree[m_assignment[row]];
            if (!m_step.isOpen(branch.observation)) continue;
            const auto test = m_step.joint().test(branch.observation, branch.landmark);
            const double logRatio = m_step.pairOf(branch).logRatio;
            if (!test || !(test->logDensity + 0.5 * test->distance2 +
                               (std::isnan(logRatio) ? 0 : logRatio) >=
                           m_score.unexplained(branch.observation)))
                continue;
            m_step.pair(branch.observation, branch.landmark, EReason::nearest);
            found = true;
        }
    }
}

template <int DIM>
void CWeighing<DIM>::settleTheRest() {
    std::vector<std::optional<EReason>> reasons(m_problem.measurements.size());
    for (std::size_t row = 0; row < m_doubts.size(); ++row) {
        const std::size_t observation = m_search.rows()[row].observation;
        if (!m_step.isOpen(observation)) continue;
        if (m_assignment[row] != none)
            reasons[observation] = m_doubts[row].value_or(EReason::improbable);
    }
    for (std::size_t i = 0; i < reasons.size(); ++i)
        if (m_step.isOpen(i))
            m_step.settle(i, reasons[i] ? *reasons[i] : m_step.whyUnpaired(i), true);
}

template <int DIM>
TAssociation CWeighing<DIM>::run() {
    double score = 0;  // of what lies near no landmark
    std::vector<bool> hasRow(m_problem.measurements.size(), false);
    for (const TExplainable& row : m_search.rows()) hasRow[row.observation] = true;
    for (std::size_t i = 0; i < hasRow.size(); ++i)
        if (m_step.isOpen(i) && !hasRow[i])
            score += std::max(m_score.unexplained(i), m_score.clutter(i));
    findBest();
    if (m_complete) findDoubts();
    for (std::size_t row = 0; row < m_doubts.size(); ++row)
        if (m_doubts[row]) m_step.defer(m_search.rows()[row].observation, *m_doubts[row]);
    if (m_complete) {
        dropOutliers();
        pairTheSharp();
        settleTheRest();
    } else {
        CBestFirst<DIM>(m_options, m_step, m_problem).run();
    }
    TAssociation result = m_step.finish({m_tree.nodes(), m_tree.tests(), m_complete});
    result.score = score + m_best.score;
    return result;
}

}  // namespace

CSaliencyAssociation::CSaliencyAssociation(const TAssociationOptions& options)
    : m_options(options) {
    m_options.validate();
}

template <int DIM>
TAssociation CSaliencyAssociation::associateIn(const TAssociationProblemOf<DIM>& problem) const {
    CGatedStep step(m_options, problem);
    step.weighAppearance();
    return CWeighing(m_options, problem, step).run();
}

TAssociation CSaliencyAssociation::associate(const TAssociationProblem& problem) const {
    return associateIn(problem);
}

TAssociation CSaliencyAssociation::associate(const TAssociationProblem3D& problem) const {
    return associateIn(problem);
}

}  // namespace salma::association
