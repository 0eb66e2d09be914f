// SPDX-License-Identifier: BSD-3-Clause
#include "CBestFirst.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "CChiSquareGate.h"
#include "CHypothesisScore.h"

namespace salma::association {

template <int DIM>
CBestFirst<DIM>::CBestFirst(const TAssociationOptions& options,
                            CGatedStep<DIM>& step,
                            const TAssociationProblemOf<DIM>& problem)
    : m_options(options),
      m_step(step),
      m_gate(chiSquareQuantile(options.gateQuantile, DIM)),
      m_problem(problem),
      m_scores(problem.measurements.size()) {}

template <int DIM>
void CBestFirst<DIM>::score() {
    for (std::size_t i = 0; i < m_scores.size(); ++i) {
        m_scores[i].clear();
        if (!m_step.isOpen(i)) continue;
        for (const TPair& pair : m_step.pairs(i)) {
            if (!pair.inGate || pair.forbidden || m_step.isTaken(pair.landmark)) continue;
            const auto test = m_step.joint().test(i, pair.landmark);
            if (!test || !(test->distance2 <= m_gate) || !m_step.passesJointGate(*test)) continue;
            const double logRatio = std::isnan(pair.logRatio) ? 0 : pair.logRatio;
            const double score = test->logDensity + logRatio;
            const double detected =
                CHypothesisScore<DIM>::detectionGain(m_options, m_problem.landmarks[pair.landmark]);
            m_scores[i].push_back({&pair, score + detected, score + 0.5 * test->distance2});
        }
    }
}

template <int DIM>
double CBestFirst<DIM>::secondBest(std::size_t observation, std::size_t landmark) const {
    double found = -std::numeric_limits<double>::infinity();
    for (const TScored& scored : m_scores[observation])
        if (scored.pair->landmark != landmark) found = std::max(found, scored.score);
    return found;
}

template <int DIM>
typename CBestFirst<DIM>::TBest CBestFirst<DIM>::best(std::size_t observation) const {
    TBest result;
    result.observation = observation;
    for (const TScored& scored : m_scores[observation])
        if (scored.score > result.best.score) result.best = scored;
    if (result.best.pair == nullptr) return result;
    const std::size_t landmark = result.best.pair->landmark;
    const double second = secondBest(observation, landmark);
    result.lead = result.best.score - second;
    // A rival measurement takes the landmark away; each of the two then has its next explanation.
    const double gain = result.best.score - std::max(second, otherScore(observation));
    for (std::size_t k = 0; k < m_scores.size(); ++k)
        for (const TScored& rival : m_scores[k]) {
            if (k == observation || rival.pair->landmark != landmark) continue;
            const double loss = std::max(secondBest(k, landmark), otherScore(k));
            result.lead = std::min(result.lead, gain + loss - rival.score);
        }
    return result;
}

template <int DIM>
std::optional<EReason> CBestFirst<DIM>::objection(const TBest& candidate) const {
    if (candidate.best.pair->logRatio < m_options.acceptLogLr) return EReason::unsureAppearance;
    // Judged by the peak: a limit on the score would be a hidden, narrower gate, and a filter that
    // only hears of small innovations becomes too sure of itself.
    if (!(candidate.best.peak >= otherScore(candidate.observation))) return EReason::improbable;
    if (!(candidate.lead >= m_options.margin)) return EReason::ambiguous;
    return {};
}

template <int DIM>
void CBestFirst<DIM>::run() {
    while (true) {
        score();
        std::optional<TBest> chosen;
        for (std::size_t i = 0; i < m_scores.size(); ++i) {
            const TBest candidate = best(i);
            if (candidate.best.pair == nullptr || objection(candidate)) continue;
            if (!chosen || candidate.lead > chosen->lead ||
                (candidate.lead == chosen->lead && candidate.best.score > chosen->best.score))
                chosen = candidate;
        }
        if (!chosen) break;
        m_step.pair(chosen->observation, chosen->best.pair->landmark, EReason::nearest);
    }
    for (std::size_t i = 0; i < m_scores.size(); ++i) {
        if (!m_step.isOpen(i)) continue;
        const TBest candidate = best(i);
        m_step.settle(i, candidate.best.pair ? *objection(candidate) : m_step.whyUnpaired(i), true);
    }
}

template class CBestFirst<2>;
template class CBestFirst<3>;

}  // namespace salma::association
