// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/CGreedyClusterer.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace salma::saliency {

using observations::TSalientRegion;

namespace {

bool moreSalient(const TSalientRegion& a, const TSalientRegion& b) {
    return std::make_tuple(-a.Y, a.y, a.x, a.s) < std::make_tuple(-b.Y, b.y, b.x, b.s);
}

/** The discs kept so far, each entered in every cell of a grid that it may touch, so that a point
 * meets only the few discs of its own cell. */
class CDiscGrid {
 public:
    /// Grid over the positions of `points`, which are not empty.
    explicit CDiscGrid(const std::vector<TSalientRegion>& points) {
        const auto [left, right] = std::minmax_element(
            points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
        const auto [top, bottom] = std::minmax_element(
            points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
        m_left = left->x;
        m_top = top->y;
        const double extent = std::max(right->x - m_left, bottom->y - m_top);
        m_cellSize = std::max(8.0, extent / 1000);  // at most a million cells
        m_columns = cell(right->x - m_left) + 1;
        m_rows = cell(bottom->y - m_top) + 1;
        m_cells.resize(m_columns * m_rows);
    }

    bool covers(double x, double y) const {
        const auto& discs = m_cells[cell(y - m_top) * m_columns + cell(x - m_left)];
        return std::any_of(discs.begin(), discs.end(), [x, y](const TSalientRegion& disc) {
            const double dx = x - disc.x;
            const double dy = y - disc.y;
            return dx * dx + dy * dy <= disc.s * disc.s;
        });
    }

    void insert(const TSalientRegion& disc) {
        const std::size_t lastColumn = std::min(cell(disc.x + disc.s - m_left), m_columns - 1);
        const std::size_t lastRow = std::min(cell(disc.y + disc.s - m_top), m_rows - 1);
        for (std::size_t row = cell(disc.y - disc.s - m_top); row <= lastRow; ++row)
            for (std::size_t column = cell(disc.x - disc.s - m_left); column <= lastColumn;
                 ++column)
                m_cells[row * m_columns + column].push_back(disc);
    }

 private:
    /// Index of the cell that holds `distance`, 0 for what is before the grid.
    std::size_t cell(double distance) const {
        return static_cast<std::size_t>(std::clamp(distance / m_cellSize, 0.0, 1e6));
    }

    double m_left{0};
    double m_top{0};
    double m_cellSize{1};
    std::size_t m_columns{0};
    std::size_t m_rows{0};
    std::vector<std::vector<TSalientRegion>> m_cells;
};

}  // namespace

void TClusteringOptions::visit(config::COptionVisitor& v) {
    v.number("w_min", wMin, config::atLeast(0), "inter-scale saliency that a peak must exceed");
}

CGreedyClusterer::CGreedyClusterer(const TClusteringOptions& options) : m_options(options) {
    m_options.validate();
}

TClusteredRegions CGreedyClusterer::cluster(const std::vector<TSalientRegion>& peaks) const {
    std::vector<TSalientRegion> sorted;
    for (const auto& peak : peaks) {
        if (!std::isfinite(peak.x + peak.y + peak.s + peak.Y))
            throw std::invalid_argument("clustering: a peak's position, scale or Y is not finite");
        if (peak.W > m_options.wMin) sorted.push_back(peak);
    }
    TClusteredRegions result;
    result.belowWMin = peaks.size() - sorted.size();
    if (sorted.empty()) return result;
    std::sort(sorted.begin(), sorted.end(), moreSalient);
    CDiscGrid kept(sorted);
    for (const auto& peak : sorted) {
        if (kept.covers(peak.x, peak.y)) continue;
        kept.insert(peak);
        result.regions.push_back(peak);
    }
    result.insideStronger = sorted.size() - result.regions.size();
    return result;
}

}  // namespace salma::saliency
