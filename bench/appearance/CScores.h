// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace salma::bench {

/// A value with its 95 % interval.
struct TFigure {
    double value{0};
    double low{0}, high{0};
};

/** Scores of pairs of views, by the two posters that they show.
 *
 * Pairs share views and views share posters, so intervals come from drawing whole posters anew
 * (bootstrap, 1000 draws), not from counting pairs. */
class CScores {
 public:
    explicit CScores(std::size_t posters) : m_posters(posters), m_cells(posters * posters) {}

    void add(std::size_t posterA, std::size_t posterB, double score);

    std::vector<double> same() const { return pooled(true); }
    std::vector<double> other() const { return pooled(false); }

    TFigure meanOfSame(std::uint32_t seed) const;
    TFigure meanOfOther(std::uint32_t seed) const;
    /// Mean over the pairs of two posters; NaN without any.
    double meanOf(std::size_t posterA, std::size_t posterB) const;
    /// Area under the curve of hits over false alarms; equal scores count half.
    TFigure areaUnderCurve(std::uint32_t seed) const;

 private:
    using Weights = std::vector<int>;  //!< How often each poster was drawn.
    std::vector<double> pooled(bool same) const;
    double mean(const Weights& drawn, bool same) const;
    double area(const Weights& drawn) const;
    template <class STATISTIC>
    TFigure withInterval(std::uint32_t seed, int draws, STATISTIC statistic) const;

    std::size_t m_posters;
    std::vector<std::vector<double>> m_cells;  //!< Row: the poster of a; column: that of b.
};

/// The value below which `share` of the values lie.
double quantile(std::vector<double> values, double share);

}  // namespace salma::bench
