// SPDX-License-Identifier: BSD-3-Clause
#include "CExhaustiveSearch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace salma::association::test {
namespace {

/// Quantiles of 99 % of chi-square with 0, 2, 4, ... degrees of freedom, from printed tables.
constexpr double limits[] = {0, 9.21034037, 13.27670414, 16.81189383, 20.09023503, 23.20925116};

Eigen::Vector2d innovationOf(const TMeasurement& measurement, const TPredictedLandmark& landmark) {
    const double turn = measurement.z[1] - landmark.z[1];
    return {measurement.z[0] - landmark.z[0], std::atan2(std::sin(turn), std::cos(turn))};
}

}  // namespace

CExhaustiveSearch::CExhaustiveSearch(const TAssociationProblem& problem)
    : m_problem(problem),
      m_candidates(problem.measurements.size()),
      m_now(problem.measurements.size(), -1) {
    for (std::size_t i = 0; i < m_now.size(); ++i) {
        for (std::size_t j = 0; j < problem.landmarks.size(); ++j) {
            m_now[i] = static_cast<int>(j);
            if (distance2() <= limits[1]) m_candidates[i].push_back(m_now[i]);
        }
        m_now[i] = -1;
    }
}

TExhaustiveResult CExhaustiveSearch::mostPairings() {
    m_best = {};
    m_best.landmarks = m_now;
    for (const auto& candidates : m_candidates)
        m_best.individuallyCompatible += !candidates.empty();
    visit(0);
    return m_best;
}

void CExhaustiveSearch::visit(std::size_t observation) {
    if (observation == m_now.size()) return consider();
    for (const int landmark : m_candidates[observation]) {
        if (std::find(m_now.begin(), m_now.end(), landmark) != m_now.end()) continue;
        m_now[observation] = landmark;
        visit(observation + 1);
        m_now[observation] = -1;
    }
    visit(observation + 1);
}

void CExhaustiveSearch::consider() {
    const std::size_t pairings =
        m_now.size() - static_cast<std::size_t>(std::count(m_now.begin(), m_now.end(), -1));
    if (pairings < m_best.pairings || pairings == 0) return;
    const double distance = distance2();
    if (!(distance <= limits[pairings])) return;
    if (pairings == m_best.pairings && !(distance < m_best.distance2)) return;
    m_best.landmarks = m_now;
    m_best.pairings = pairings;
    m_best.distance2 = distance;
}

double CExhaustiveSearch::distance2() const {
    std::vector<std::size_t> paired;
    for (std::size_t i = 0; i < m_now.size(); ++i)
        if (m_now[i] >= 0) paired.push_back(i);
    const auto size = static_cast<Eigen::Index>(2 * paired.size());
    Eigen::MatrixXd S(size, size);
    Eigen::VectorXd nu(size);
    for (std::size_t a = 0; a < paired.size(); ++a) {
        const auto& measurement = m_problem.measurements[paired[a]];
        const int first = m_now[paired[a]];
        const auto row = static_cast<Eigen::Index>(2 * a);
        nu.segment<2>(row) =
            innovationOf(measurement, m_problem.landmarks[static_cast<std::size_t>(first)]);
        for (std::size_t b = 0; b < paired.size(); ++b)
            S.block<2, 2>(row, 2 * b) =
                m_problem.predictionCovariance.block<2, 2>(2 * first, 2 * m_now[paired[b]]);
        S.block<2, 2>(row, row) += measurement.R;
    }
    return nu.dot(S.inverse() * nu);
}

}  // namespace salma::association::test
