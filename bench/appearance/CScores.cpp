// SPDX-License-Identifier: BSD-3-Clause
#include "CScores.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace salma::bench {

void CScores::add(std::size_t posterA, std::size_t posterB, double score) {
    m_cells[posterA * m_posters + posterB].push_back(score);
}

std::vector<double> CScores::pooled(bool same) const {
    std::vector<double> out;
    for (std::size_t a = 0; a < m_posters; ++a)
        for (std::size_t b = 0; b < m_posters; ++b) {
            const auto& cell = m_cells[a * m_posters + b];
            if ((a == b) == same) out.insert(out.end(), cell.begin(), cell.end());
        }
    return out;
}

double CScores::mean(const Weights& drawn, bool same) const {
    double sum = 0, count = 0;
    for (std::size_t a = 0; a < m_posters; ++a)
        for (std::size_t b = 0; b < m_posters; ++b) {
            if ((a == b) != same) continue;
            const double weight = same ? drawn[a] : drawn[a] * drawn[b];
            for (const double score : m_cells[a * m_posters + b]) sum += weight * score;
            count += weight * static_cast<double>(m_cells[a * m_posters + b].size());
        }
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double CScores::meanOf(std::size_t posterA, std::size_t posterB) const {
    const auto& cell = m_cells[posterA * m_posters + posterB];
    return std::accumulate(cell.begin(), cell.end(), 0.0) / static_cast<double>(cell.size());
}

double CScores::area(const Weights& drawn) const {
    struct TItem {
        double score, same, other;
    };
    std::vector<TItem> items;
    for (std::size_t a = 0; a < m_posters; ++a)
        for (std::size_t b = 0; b < m_posters; ++b) {
            const double weight = a == b ? drawn[a] : drawn[a] * drawn[b];
            if (!(weight > 0)) continue;
            for (const double score : m_cells[a * m_posters + b])
                items.push_back({score, a == b ? weight : 0, a == b ? 0 : weight});
        }
    std::sort(items.begin(), items.end(),
              [](const TItem& x, const TItem& y) { return x.score < y.score; });
    double below = 0, area = 0, same = 0;
    for (std::size_t i = 0; i < items.size();) {
        double sameHere = 0, otherHere = 0;
        const double score = items[i].score;
        for (; i < items.size() && items[i].score == score; ++i) {
            sameHere += items[i].same;
            otherHere += items[i].other;
        }
        area += sameHere * (below + otherHere / 2);
        below += otherHere;
        same += sameHere;
    }
    return area / (same * below);
}

template <class STATISTIC>
TFigure CScores::withInterval(std::uint32_t seed, int draws, STATISTIC statistic) const {
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::size_t> poster(0, m_posters - 1);
    std::vector<double> values;
    for (int i = 0; i < draws; ++i) {
        Weights drawn(m_posters, 0);
        for (std::size_t k = 0; k < m_posters; ++k) ++drawn[poster(random)];
        const double value = statistic(drawn);
        if (std::isfinite(value)) values.push_back(value);
    }
    return {statistic(Weights(m_posters, 1)), quantile(values, 0.025), quantile(values, 0.975)};
}

TFigure CScores::meanOfSame(std::uint32_t seed) const {
    return withInterval(seed, 1000, [&](const Weights& w) { return mean(w, true); });
}

TFigure CScores::meanOfOther(std::uint32_t seed) const {
    return withInterval(seed, 1000, [&](const Weights& w) { return mean(w, false); });
}

TFigure CScores::areaUnderCurve(std::uint32_t seed) const {
    return withInterval(seed, 200, [&](const Weights& w) { return area(w); });
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::sort(values.begin(), values.end());
    const double place = share * static_cast<double>(values.size() - 1);
    return values[static_cast<std::size_t>(std::lround(place))];
}

}  // namespace salma::bench
