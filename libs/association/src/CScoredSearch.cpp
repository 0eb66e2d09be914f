// SPDX-License-Identifier: BSD-3-Clause
#include "CScoredSearch.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace salma::association {
namespace {

constexpr double noScore = -std::numeric_limits<double>::infinity();

bool contains(const std::vector<std::size_t>& branches, std::size_t branch) {
    return std::find(branches.begin(), branches.end(), branch) != branches.end();
}

/// Of a symmetric matrix.
double largestEigenvalue(const Eigen::Matrix2d& m) {
    const double half = (m(0, 0) - m(1, 1)) / 2;
    return m.trace() / 2 + std::sqrt(half * half + m(1, 0) * m(1, 0));
}

double largestEigenvalue(const Eigen::Matrix3d& m) {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m, Eigen::EigenvaluesOnly)
        .eigenvalues()[2];
}

}  // namespace

template <int DIM>
CScoredSearch<DIM>::CScoredSearch(CInterpretationTree<DIM>& tree,
                                  const CHypothesisScore<DIM>& score,
                                  const CChiSquareGate& gate,
                                  double newDistance2)
    : m_tree(tree), m_score(score), m_gate(gate), m_newDistance2(newDistance2) {
    for (std::size_t k = 0; k < tree.size(); ++k)
        m_landmarks = std::max(m_landmarks, tree[k].landmark + 1);
}

template <int DIM>
TScoredHypothesis CScoredSearch<DIM>::find(const TSearchGoal& goal, std::size_t lastTest) {
    m_goal = goal;
    m_lastTest = lastTest;
    m_complete = m_tree.tests() < lastTest;
    m_best = {};
    if (!m_complete) return m_best;
    m_best.score = goal.threshold;
    TRows rows;
    for (const TExplainable& what : m_all) {
        TRow row;
        row.what = &what;
        for (const std::size_t branch : what.pairable)
            if (branch != goal.withoutBranch) row.survivors.push_back(branch);
        rows.push_back(row);
    }
    explore(judged(rows));
    return m_best.score > goal.threshold ? m_best : TScoredHypothesis{};
}

/* Pairings still to come that shift the innovation by delta, and take its covariance from S to no
 * less than the floor F, have a joint distance theta of at least delta' (S - F)^-1 delta. */
template <int DIM>
typename CScoredSearch<DIM>::TReach CScoredSearch<DIM>::reach(std::size_t branch,
                                                              const TBranchTest& tested,
                                                              const TProspect& prospect) const {
    const std::size_t landmark = m_tree[branch].landmark;
    const bool shared = prospect.claims[landmark] > 0 || m_tree.isTaken(landmark);
    const auto& floor = m_score.floor(branch, shared);
    TReach result;
    if (!floor) return result;
    result.now = (*floor * m_tree.value(branch)).norm();
    const TReadingCovariance<DIM> grown = floor->ofCovariance(m_tree.covariance(branch));
    // Largest eigenvalue of S - F in units of F; a little more, against rounding.
    result.excess = std::max(0., largestEigenvalue(grown) - 1) + 1e-9;
    const double shift = std::sqrt(result.excess / (1 + result.excess) * prospect.room);
    const double nearest = std::sqrt(tested.distance2) - shift;
    result.nearest2 = nearest > 0 ? nearest * nearest : 0;
    return result;
}

/// The theta that it takes to carry an innovation to a distance.
template <int DIM>
double CScoredSearch<DIM>::costOf(const TReach& reach, double distance) {
    const double shift = distance - reach.now;
    return shift > 0 ? shift * shift / reach.excess : 0;
}

template <int DIM>
typename CScoredSearch<DIM>::TRow CScoredSearch<DIM>::judged(const TRow& row, TProspect& prospect) {
    TRow result;
    result.what = row.what;
    result.surelyClear = true;
    result.clutter = m_score.clutter(row.what->observation);
    std::vector<std::pair<double, std::size_t>> likely;
    double mostRegretted = noScore;
    // Only claims of others count.
    for (const std::size_t branch : row.survivors) --prospect.claims[m_tree[branch].landmark];
    for (const std::size_t branch : row.what->near) {
        const TBranchTest tested = m_tree.test(branch);
        if (!std::isfinite(tested.distance2)) {  // counts as near
            result.clearCost = std::numeric_limits<double>::infinity();
            result.surelyClear = false;
            continue;
        }
        const TReach reached = reach(branch, tested, prospect);
        result.clearCost = std::max(result.clearCost, costOf(reached, std::sqrt(m_newDistance2)));
        result.surelyClear = result.surelyClear && reached.nearest2 > m_newDistance2;
        if (m_tree.isTaken(m_tree[branch].landmark)) continue;
        const double peak = m_score.gain(branch) + tested.logPeak;
        if (contains(row.survivors, branch) && tested.distance2 <= prospect.room)
            likely.emplace_back(peak - 0.5 * tested.distance2, branch);
        if (branch != m_goal.withoutBranch && contains(row.what->pairable, branch) &&
            peak - 0.5 * reached.now * reached.now > mostRegretted) {
            mostRegretted = peak - 0.5 * reached.now * reached.now;
            result.rejected = branch;
            result.rejectedPeak = peak;
            result.rejectedReach = reached;
        }
    }
    for (const std::size_t branch : row.survivors) ++prospect.claims[m_tree[branch].landmark];
    std::sort(likely.begin(), likely.end(), std::greater<>());
    rate(likely, prospect.room, result);
    return result;
}

template <int DIM>
void CScoredSearch<DIM>::rate(const std::vector<std::pair<double, std::size_t>>& likely,
                              double room,
                              TRow& row) const {
    row.bestAlone = row.clutter;
    if (row.clearCost <= room)
        row.bestAlone = std::max(row.clutter, m_score.unexplained(row.what->observation));
    if (m_goal.pairedRow < m_all.size() && row.what == &m_all[m_goal.pairedRow])
        row.bestAlone = row.clutter = noScore;
    row.bestCase = row.bestAlone;
    for (const auto& scored : likely) {
        row.survivors.push_back(scored.second);
        row.bestCase = std::max(row.bestCase, m_score.bound(scored.second));
    }
    row.left = likely.empty();
    if (row.left) return;
    const double second = likely.size() > 1 ? likely[1].first : noScore;
    row.lead = likely[0].first - std::max(row.bestAlone, second);
}

template <int DIM>
typename CScoredSearch<DIM>::TRows CScoredSearch<DIM>::judged(const TRows& rows) {
    const auto open = static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [](const TRow& row) { return !row.left; }));
    TProspect prospect;
    prospect.room = m_gate(m_tree.depth() + open) - m_tree.distance2();
    prospect.claims.assign(m_landmarks, 0);
    for (const TRow& row : rows)
        for (const std::size_t branch : row.survivors) ++prospect.claims[m_tree[branch].landmark];
    TRows result;
    result.reserve(rows.size());
    for (const TRow& row : rows) result.push_back(judged(row, prospect));
    return result;
}

template <int DIM>
bool CScoredSearch<DIM>::promises(const TRows& rows) const {
    std::size_t open = 0;
    for (const TRow& row : rows) open += !row.left;
    return m_tree.distance2() <= m_gate(m_tree.depth() + open) && bound(rows, 0) > m_best.score &&
           std::all_of(rows.begin(), rows.end(), [&](const TRow& row) {
               return !row.left || !row.rejected || boundWithout(row, rows) > m_best.score;
           });
}

/* Largest score of hypotheses below whose pairings to come have a joint distance theta of at least
 * `leastTheta`. To be clear of its landmarks a measurement may need more, but all can share it. */
template <int DIM>
double CScoredSearch<DIM>::bound(const TRows& rows, double leastTheta) const {
    double score = m_pathScore;
    std::vector<std::pair<double, double>> clearings;  // cost, gain
    for (const TRow& row : rows) {
        if (!row.left || row.clearCost <= leastTheta || row.bestAlone <= row.clutter) {
            score += row.bestCase;
        } else {
            score += row.clutter;
            clearings.emplace_back(row.clearCost, row.bestAlone - row.clutter);
        }
    }
    std::sort(clearings.begin(), clearings.end());
    double best = score - 0.5 * leastTheta;
    for (const auto& [cost, gain] : clearings) {
        score += gain;
        best = std::max(best, score - 0.5 * cost);
    }
    return best;
}

/* A hypothesis that leaves a measurement out though its pairing would raise the score is not the
 * best one. So a hypothesis below either has a theta so large that the pairing would not pay, or it
 * is so near to the joint gate that it has no room for the pairing. */
template <int DIM>
double CScoredSearch<DIM>::boundWithout(const TRow& left, const TRows& rows) const {
    const double infinity = std::numeric_limits<double>::infinity();
    const std::size_t landmark = m_tree[*left.rejected].landmark;
    double score = m_pathScore;
    std::vector<double> gains;
    for (const TRow& row : rows) {
        for (const std::size_t branch : row.survivors)
            if (m_tree[branch].landmark == landmark) return infinity;  // not free
        score += row.left ? row.bestCase : row.bestAlone;
        if (!row.left) gains.push_back(row.bestCase - row.bestAlone);
    }
    if (!(score > noScore)) return infinity;  // a measurement that must be paired is open
    const auto thetaFor = [&](double regret) {
        const double worst = left.rejectedPeak - std::max(left.bestAlone, left.clutter) - regret;
        return worst > 0 ? costOf(left.rejectedReach, std::sqrt(2 * worst)) : 0;
    };
    // The pairing may bring others near to landmarks that they were clear of.
    const double most = thetaFor(0);
    double flips = 0;
    for (const TRow& row : rows)
        if (&row != &left && row.clearCost < most && !row.surelyClear)
            flips += std::max(0., row.bestAlone - row.clutter);
    const double theta = thetaFor(flips);
    if (!(theta > 0)) return infinity;
    const double farthest = left.rejectedReach.now + std::sqrt(left.rejectedReach.excess * theta);
    std::sort(gains.begin(), gains.end(), std::greater<>());
    double best = bound(rows, theta);
    for (std::size_t more = 0; more <= gains.size(); ++more) {
        if (more > 0) score += gains[more - 1];
        const double least =
            m_gate(m_tree.depth() + more + 1) - farthest * farthest - m_tree.distance2();
        if (least <= theta) best = std::max(best, score - 0.5 * std::max(0., least));
    }
    return best;
}

template <int DIM>
double CScoredSearch<DIM>::aloneScore(const TExplainable& row) {
    const double clutter = m_score.clutter(row.observation);
    const double unexplained = m_score.unexplained(row.observation);
    if (clutter >= unexplained) return clutter;
    for (const std::size_t branch : row.near) {
        const double distance2 = m_tree.test(branch).distance2;
        if (!std::isfinite(distance2) || distance2 <= m_newDistance2) return clutter;
    }
    return unexplained;
}

template <int DIM>
void CScoredSearch<DIM>::weigh(const TRows& rows) {
    if (!(m_tree.distance2() <= m_gate(m_tree.depth()))) return;
    double score = m_pathScore;
    for (const TRow& row : rows) score += aloneScore(*row.what);
    if (!(score > m_best.score)) return;
    m_best.branches = m_path;
    std::sort(m_best.branches.begin(), m_best.branches.end());
    m_best.score = score;
}

template <int DIM>
bool CScoredSearch<DIM>::isOver() {
    if (m_goal.any && m_best.score > m_goal.threshold) return true;
    m_complete = m_complete && m_tree.tests() < m_lastTest;
    return !m_complete;
}

template <int DIM>
void CScoredSearch<DIM>::explore(const TRows& rows) {
    if (!promises(rows)) return;
    if (isOver()) return;
    const auto next = std::max_element(rows.begin(), rows.end(), [](const TRow& a, const TRow& b) {
        return std::make_pair(!a.left, a.lead) < std::make_pair(!b.left, b.lead);
    });
    if (next == rows.end() || next->left) return weigh(rows);
    TRows others;
    others.reserve(rows.size());
    for (auto row = rows.begin(); row != rows.end(); ++row)
        if (row != next) others.push_back(*row);
    for (const std::size_t branch : next->survivors) {
        if (isOver()) return;
        const TBranchTest tested = m_tree.test(branch);
        if (!m_tree.descend(branch)) continue;
        const double before = m_pathScore;
        m_pathScore += m_score.gain(branch) + tested.logPeak - 0.5 * tested.distance2;
        m_path.push_back(branch);
        explore(judged(others));
        m_path.pop_back();
        m_pathScore = before;
        m_tree.ascend();
    }
    if (isOver()) return;
    if (!(next->bestAlone > noScore)) return;
    TRow alone = *next;
    alone.left = true;
    alone.survivors.clear();
    alone.bestCase = alone.bestAlone;
    others.push_back(alone);
    explore(others);
}

template class CScoredSearch<2>;
template class CScoredSearch<3>;

}  // namespace salma::association
