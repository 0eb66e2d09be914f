// SPDX-License-Identifier: BSD-3-Clause
#include "CExhaustiveSearch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace salma::association::test {
namespace {

/// Quantiles of 99 % of chi-square with 0, DIM, 2 DIM, ... degrees of freedom, from printed tables.
template <int DIM>
constexpr double limits[] = {0, 9.21034037, 13.27670414, 16.81189383, 20.09023503, 23.20925116};
template <>
constexpr double limits<3>[] = {0, 11.34486673, 16.81189383, 21.66599433, 26.21696731, 30.57791417};

template <int DIM>
TReading<DIM> innovationOf(const TMeasurementOf<DIM>& measurement,
                           const TPredictedLandmarkOf<DIM>& landmark) {
    TReading<DIM> nu = measurement.z - landmark.z;
    for (int k = 1; k < DIM; ++k) nu[k] = std::atan2(std::sin(nu[k]), std::cos(nu[k]));
    return nu;
}

}  // namespace

template <int DIM>
CExhaustiveSearch<DIM>::CExhaustiveSearch(const TAssociationProblemOf<DIM>& problem)
    : m_problem(problem),
      m_candidates(problem.measurements.size()),
      m_now(problem.measurements.size(), -1) {
    for (std::size_t i = 0; i < m_now.size(); ++i) {
        for (std::size_t j = 0; j < problem.landmarks.size(); ++j) {
            m_now[i] = static_cast<int>(j);
            if (distance2() <= limits<DIM>[1]) m_candidates[i].push_back(m_now[i]);
        }
        m_now[i] = -1;
    }
}

template <int DIM>
TExhaustiveResult CExhaustiveSearch<DIM>::mostPairings() {
    m_best = {};
    m_best.landmarks = m_now;
    for (const auto& candidates : m_candidates)
        m_best.individuallyCompatible += !candidates.empty();
    visit(0, [this] { consider(); });
    return m_best;
}

template <int DIM>
void CExhaustiveSearch<DIM>::visit(std::size_t observation, const std::function<void()>& consider) {
    if (observation == m_now.size()) return consider();
    for (const int landmark : m_candidates[observation]) {
        if (std::find(m_now.begin(), m_now.end(), landmark) != m_now.end()) continue;
        m_now[observation] = landmark;
        visit(observation + 1, consider);
        m_now[observation] = -1;
    }
    visit(observation + 1, consider);
}

template <int DIM>
void CExhaustiveSearch<DIM>::consider() {
    const std::size_t pairings =
        m_now.size() - static_cast<std::size_t>(std::count(m_now.begin(), m_now.end(), -1));
    if (pairings < m_best.pairings || pairings == 0) return;
    const double distance = distance2();
    if (!(distance <= limits<DIM>[pairings])) return;
    if (pairings == m_best.pairings && !(distance < m_best.distance2)) return;
    m_best.landmarks = m_now;
    m_best.pairings = pairings;
    m_best.distance2 = distance;
}

template <int DIM>
double CExhaustiveSearch<DIM>::distance2() const {
    std::vector<double> values;
    for (std::size_t i = 0; i < m_now.size(); ++i) {
        if (m_now[i] < 0) continue;
        const TReading<DIM> own = innovationOf(
            m_problem.measurements[i], m_problem.landmarks[static_cast<std::size_t>(m_now[i])]);
        values.insert(values.end(), own.begin(), own.end());
    }
    const Eigen::Map<const Eigen::VectorXd> nu(values.data(),
                                               static_cast<Eigen::Index>(values.size()));
    return nu.dot(covariance().inverse() * nu);
}

template <int DIM>
double CExhaustiveSearch<DIM>::logDeterminant() const {
    return std::log((2 * M_PI * covariance()).determinant());
}

template <int DIM>
Eigen::MatrixXd CExhaustiveSearch<DIM>::covariance() const {
    std::vector<std::size_t> paired;
    for (std::size_t i = 0; i < m_now.size(); ++i)
        if (m_now[i] >= 0) paired.push_back(i);
    const auto size = static_cast<Eigen::Index>(DIM * paired.size());
    Eigen::MatrixXd S(size, size);
    for (std::size_t a = 0; a < paired.size(); ++a) {
        const auto row = static_cast<Eigen::Index>(DIM * a);
        for (std::size_t b = 0; b < paired.size(); ++b)
            S.block<DIM, DIM>(row, static_cast<Eigen::Index>(DIM * b)) =
                m_problem.predictionCovariance.template block<DIM, DIM>(DIM * m_now[paired[a]],
                                                                        DIM * m_now[paired[b]]);
        S.block<DIM, DIM>(row, row) += m_problem.measurements[paired[a]].R;
    }
    return S;
}

template <int DIM>
void CExhaustiveSearch<DIM>::dropForbidden(const TAssociationOptions& options) {
    for (std::size_t i = 0; i < m_candidates.size(); ++i) {
        auto& candidates = m_candidates[i];
        candidates.clear();
        for (std::size_t j = 0; j < m_problem.landmarks.size(); ++j) {
            const auto& landmark = m_problem.landmarks[j];
            if (landmark.kind != m_problem.measurements[i].kind) continue;
            const int index = static_cast<int>(j);
            const bool asked = m_problem.logRatio && landmark.kind == ELandmarkKind::salient;
            m_ratios[{i, index}] = asked ? m_problem.logRatio(i, j) : std::nan("");
            if (m_ratios[{i, index}] <= options.forbidLogLr) continue;
            candidates.push_back(index);
        }
    }
}

template <int DIM>
bool CExhaustiveSearch<DIM>::isNear(std::size_t observation, const TAssociationOptions& options) {
    const std::vector<int> hypothesis = m_now;
    const double before = distance2();
    bool near = false;
    for (const int landmark : m_candidates[observation]) {
        std::fill(m_now.begin(), m_now.end(), -1);
        m_now[observation] = landmark;
        const bool alone = distance2() <= options.newDistance2;
        m_now = hypothesis;
        m_now[observation] = landmark;
        near = near || (alone && distance2() - before <= options.newDistance2);
        m_now = hypothesis;
    }
    return near;
}

template <int DIM>
double CExhaustiveSearch<DIM>::score(const TAssociationOptions& options) {
    double score = -0.5 * (distance2() + logDeterminant());
    if (std::count(m_now.begin(), m_now.end(), -1) == static_cast<int>(m_now.size())) score = 0;
    for (std::size_t i = 0; i < m_now.size(); ++i) {
        const bool corner = m_problem.measurements[i].kind == ELandmarkKind::corner;
        if (m_now[i] >= 0) {
            const auto& stated = m_problem.landmarks[static_cast<std::size_t>(m_now[i])].detection;
            const double found = stated ? stated->found : options.detectionProbability;
            const double seen = stated ? stated->inView * stated->found : found;
            const double ratio = m_ratios[{i, m_now[i]}];
            score += std::log(found / (1 - seen)) + (std::isnan(ratio) ? 0 : ratio);
            continue;
        }
        const double clutter =
            corner ? options.cornerClutterLogDensity : options.salientClutterLogDensity;
        const double unexplained = corner ? options.cornerLogDensity : options.salientLogDensity;
        score += isNear(i, options) ? clutter : std::max(clutter, unexplained);
    }
    return score;
}

template <int DIM>
TScoredResult CExhaustiveSearch<DIM>::bestScored(const TAssociationOptions& options) {
    dropForbidden(options);
    const auto everything = m_candidates;  // what a new landmark must be clear of
    std::vector<std::pair<double, std::vector<int>>> all;
    std::fill(m_now.begin(), m_now.end(), -1);
    const auto isInGate = [this](std::size_t i, int landmark) {
        m_now[i] = landmark;
        const bool inGate = distance2() <= limits<DIM>[1];
        m_now[i] = -1;
        return inGate;
    };
    for (std::size_t i = 0; i < m_candidates.size(); ++i) {
        auto& list = m_candidates[i];
        list.erase(std::remove_if(list.begin(), list.end(),
                                  [&](int landmark) { return !isInGate(i, landmark); }),
                   list.end());
    }
    const auto pairable = m_candidates;
    visit(0, [&] {
        const auto pairings =
            m_now.size() - static_cast<std::size_t>(std::count(m_now.begin(), m_now.end(), -1));
        if (pairings > 0 && !(distance2() <= limits<DIM>[pairings])) return;
        m_candidates = everything;
        all.emplace_back(score(options), m_now);
        m_candidates = pairable;
    });
    const auto best = std::max_element(all.begin(), all.end());
    TScoredResult result{best->second, best->first, std::vector<bool>(m_now.size(), false)};
    for (const auto& [score, landmarks] : all)
        if (score > best->first - options.margin)
            for (std::size_t i = 0; i < m_now.size(); ++i)
                if (landmarks[i] != best->second[i]) result.ambiguous[i] = true;
    return result;
}

template class CExhaustiveSearch<2>;
template class CExhaustiveSearch<3>;

}  // namespace salma::association::test
