// SPDX-License-Identifier: BSD-3-Clause
#include <salma/laser/CRevisitModel.h>

#include <boost/math/special_functions/digamma.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace salma::laser {
namespace {

constexpr double kVague = 0.5;   // Jeffreys' prior
constexpr double kLeast = 1e-3;  // of an imagined count: nothing is impossible in a new building
constexpr double kMost = 1e4;    // of a row: buildings that are all alike fit any large number
constexpr int kRounds = 500;
constexpr double kFloor = 1e-6;  // of a probability

double sum(const TPlaceVector& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

void checkNumbers(const TPlaceVector& v, const std::string& what) {
    for (const double value : v)
        if (!(value >= 0 && std::isfinite(value)))
            throw std::invalid_argument("revisit model: " + what + " is negative or not finite");
}

/// One row of the prior.
TPlaceVector fitRow(const std::vector<TPlaceMatrix>& buildings, std::size_t from) {
    using boost::math::digamma;
    TPlaceVector alpha;
    alpha.fill(kVague);
    for (int round = 0; round < kRounds; ++round) {
        const double all = sum(alpha);
        double below = 0;
        TPlaceVector above{};
        for (const TPlaceMatrix& counts : buildings) {
            const double n = sum(counts[from]);
            if (!(n > 0)) continue;
            below += digamma(n + all) - digamma(all);
            for (std::size_t to = 0; to < kPlaceClasses; ++to)
                if (counts[from][to] > 0)
                    above[to] += digamma(counts[from][to] + alpha[to]) - digamma(alpha[to]);
        }
        if (!(below > 0)) break;  // never seen: stays vague
        double change = 0;
        for (std::size_t to = 0; to < kPlaceClasses; ++to) {
            const double next = std::max(kLeast, alpha[to] * above[to] / below);
            change = std::max(change, std::abs(next - alpha[to]) / alpha[to]);
            alpha[to] = next;
        }
        if (change < 1e-6 || sum(alpha) > kMost) break;
    }
    return alpha;
}

}  // namespace

TPlaceMatrix fitPlacePrior(const std::vector<TPlaceMatrix>& buildings) {
    for (const auto& counts : buildings)
        for (const auto& row : counts) checkNumbers(row, "a count");
    TPlaceMatrix prior;
    for (std::size_t i = 0; i < kPlaceClasses; ++i) prior[i] = fitRow(buildings, i);
    return prior;
}

void TRevisitOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.number("outside_at_start", outsideAtStart, insideOf(0, 1), "probability to begin outside");
    v.number("leave", leave, insideOf(0, 1), "probability of a step out, at an exit");
    v.number("enter", enter, insideOf(0, 1), "probability of a step into the map, from outside");
    v.number("lost", lost, between(0, 0.5), "probability of a step that the map does not know");
    v.number("evidence", evidence, {0, 1, true, false}, "exponent of a scan's probabilities");
}

CRevisitModel::CRevisitModel(const TRevisitOptions& options,
                             const TPlaceMatrix& prior,
                             std::vector<TMapPlace> map)
    : m_options(options), m_counts(prior), m_map(std::move(map)) {
    m_options.validate();
    for (const auto& row : m_counts) {
        checkNumbers(row, "a count");
        for (const double count : row)
            if (!(count > 0)) throw std::invalid_argument("revisit model: a count is not positive");
    }
    for (const TMapPlace& place : m_map) {
        checkNumbers(place.classes, "a class of a place");
        if (!(std::abs(sum(place.classes) - 1) < 1e-6))
            throw std::invalid_argument("revisit model: the classes of a place have not sum 1");
        for (const std::size_t next : place.next)
            if (next >= m_map.size())
                throw std::invalid_argument(
                    "revisit model: a place leads to one that is not there");
        if (place.entry) ++m_entries;
        // what the map shows of this building counts for its unknown part too
        for (const std::size_t next : place.next)
            for (std::size_t i = 0; i < kPlaceClasses; ++i)
                for (std::size_t j = 0; j < kPlaceClasses; ++j)
                    m_counts[i][j] += place.classes[i] * m_map[next].classes[j] /
                                      static_cast<double>(place.next.size());
    }
    if (m_entries == 0) throw std::invalid_argument("revisit model: the map has no entry");
    m_inside.assign(m_map.size(),
                    (1 - m_options.outsideAtStart) / static_cast<double>(m_map.size()));
    m_outside.fill(m_options.outsideAtStart / kPlaceClasses);
}

TPlaceMatrix CRevisitModel::structure() const {
    TPlaceMatrix next = m_counts;
    for (auto& row : next) {
        const double all = sum(row);
        for (double& count : row) count /= all;
    }
    return next;
}

double CRevisitModel::outside() const { return sum(m_outside); }

double CRevisitModel::update(const TPlaceVector& scan) {
    checkNumbers(scan, "a scan's probability");
    if (!(sum(scan) > 0))
        throw std::invalid_argument("revisit model: a scan that rules out every class");
    TPlaceVector likelihood;
    for (std::size_t c = 0; c < kPlaceClasses; ++c)
        likelihood[c] = std::pow(scan[c] + kFloor, m_options.evidence);
    std::vector<double> inside = m_inside;
    TPlaceVector outside = m_outside;
    const TPlaceMatrix structure = this->structure();
    if (m_begun) {
        // what enters the map from outside does so at any entry
        const double entering = m_options.enter * sum(m_outside);
        outside.fill(0);
        for (std::size_t i = 0; i < kPlaceClasses; ++i)
            for (std::size_t j = 0; j < kPlaceClasses; ++j)
                outside[j] += (1 - m_options.enter) * m_outside[i] * structure[i][j];
        std::fill(inside.begin(), inside.end(), 0.0);
        for (std::size_t k = 0; k < m_map.size(); ++k) {
            const TMapPlace& place = m_map[k];
            double leaving = m_inside[k] * (place.exit ? m_options.leave : m_options.lost);
            if (place.next.empty()) leaving = m_inside[k];
            const double staying = m_inside[k] - leaving;
            for (const std::size_t next : place.next)
                inside[next] += staying / static_cast<double>(place.next.size());
            if (place.entry) inside[k] += entering / static_cast<double>(m_entries);
            for (std::size_t i = 0; i < kPlaceClasses; ++i)
                for (std::size_t j = 0; j < kPlaceClasses; ++j)
                    outside[j] += leaving * place.classes[i] * structure[i][j];
        }
    }
    double all = 0;
    for (std::size_t c = 0; c < kPlaceClasses; ++c) all += outside[c] *= likelihood[c];
    for (std::size_t k = 0; k < m_map.size(); ++k) {
        double seen = 0;
        for (std::size_t c = 0; c < kPlaceClasses; ++c) seen += m_map[k].classes[c] * likelihood[c];
        all += inside[k] *= seen;
    }
    for (double& p : outside) p /= all;
    for (double& p : inside) p /= all;
    if (m_begun)  // what is outside tells how this building goes on; counted by its probability
        for (std::size_t i = 0; i < kPlaceClasses; ++i)
            for (std::size_t j = 0; j < kPlaceClasses; ++j) {
                const double before = m_outside[i] * structure[i][j];
                if (before > 0)
                    m_counts[i][j] += before * likelihood[j] * (1 - m_options.enter) / all;
            }
    m_inside = std::move(inside);
    m_outside = outside;
    m_begun = true;
    return this->outside();
}

}  // namespace salma::laser
