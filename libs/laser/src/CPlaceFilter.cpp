// SPDX-License-Identifier: BSD-3-Clause
#include <salma/laser/CPlaceFilter.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "placeModel.h"

namespace salma::laser {
namespace {

constexpr double kLeast = 1e-6;  // no class is ever ruled out for good

/// \throw std::invalid_argument
double checkedSum(const TPlaceVector& values) {
    for (const double value : values)
        if (!(value >= 0 && std::isfinite(value)))
            throw std::invalid_argument("place filter: a probability is negative or not finite");
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TPlaceTransitions shippedPlaceTransitions() { return {kPlaceGoingOn, kPlaceTurning}; }

void TPlaceFilterOptions::visit(config::COptionVisitor& v) {
    v.number("evidence", evidence, {0, 1, true, false}, "exponent of a scan's probabilities");
    v.number("surprise", surprise, config::between(0, 1),
             "probability that what comes next has nothing to do with what was");
}

CPlaceFilter::CPlaceFilter(const TPlaceFilterOptions& options, const TPlaceTransitions& transitions)
    : m_options(options), m_transitions(transitions) {
    m_options.validate();
    for (const TPlaceMatrix* matrix : {&m_transitions.goingOn, &m_transitions.turning})
        for (const TPlaceVector& row : *matrix)
            if (!(std::abs(checkedSum(row) - 1) <= 1e-3))
                throw std::invalid_argument("place filter: a row of transitions has not sum 1");
    m_belief.fill(1.0 / kPlaceClasses);
}

void CPlaceFilter::predict(EPlaceStep step) {
    const TPlaceMatrix& transitions =
        step == EPlaceStep::turning ? m_transitions.turning : m_transitions.goingOn;
    TPlaceVector next{};
    for (std::size_t i = 0; i < kPlaceClasses; ++i)
        for (std::size_t j = 0; j < kPlaceClasses; ++j) next[j] += m_belief[i] * transitions[i][j];
    for (std::size_t j = 0; j < kPlaceClasses; ++j)
        m_belief[j] = (1 - m_options.surprise) * next[j] + m_options.surprise / kPlaceClasses;
}

const TPlaceVector& CPlaceFilter::update(const TPlaceVector& scan, EPlaceStep step) {
    if (!(checkedSum(scan) > 0))
        throw std::invalid_argument("place filter: a scan that rules out every class");
    predict(step);
    double sum = 0;
    for (std::size_t i = 0; i < kPlaceClasses; ++i)
        sum += m_belief[i] =
            (m_belief[i] + kLeast) * std::pow(scan[i] + kLeast, m_options.evidence);
    for (double& value : m_belief) value /= sum;
    return m_belief;
}

const TPlaceVector& CPlaceFilter::skip(EPlaceStep step) {
    predict(step);
    return m_belief;
}

}  // namespace salma::laser
