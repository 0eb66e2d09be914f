// SPDX-License-Identifier: BSD-3-Clause
#include "CNeighbourGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace salma::saliency {
namespace {

/// Points are crowded, so that boxes of the mean density would hold too many where they are.
constexpr double kPointsInBox = 0.3;

}  // namespace

CNeighbourGrid::CNeighbourGrid(const std::vector<TPlaceAndScale>& points, std::size_t count)
    : m_count(std::min(count, points.size())), m_low(points[0]) {
    TPlaceAndScale high = points[0];
    for (const auto& p : points)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            m_low[axis] = std::min(m_low[axis], p[axis]);
            high[axis] = std::max(high[axis], p[axis]);
        }
    for (std::size_t axis = 0; axis < 3; ++axis) m_extent[axis] = high[axis] - m_low[axis];
    chooseCells(points.size());
    const auto cell = [this](const TPlaceAndScale& p) {
        return flat(cellOf(p[0], 0), cellOf(p[1], 1), cellOf(p[2], 2));
    };
    m_first.assign(flat(m_cells[0] - 1, m_cells[1] - 1, m_cells[2] - 1) + 2, 0);
    for (const auto& p : points) ++m_first[cell(p) + 1];
    for (std::size_t c = 1; c < m_first.size(); ++c) m_first[c] += m_first[c - 1];
    m_entries.resize(points.size());
    auto next = m_first;
    for (std::size_t i = 0; i < points.size(); ++i)
        m_entries[next[cell(points[i])]++] = {points[i], i};
}

std::vector<std::size_t> CNeighbourGrid::byPlace() const {
    std::vector<std::size_t> indices;
    indices.reserve(m_entries.size());
    for (const auto& entry : m_entries) indices.push_back(entry.index);
    return indices;
}

void CNeighbourGrid::chooseCells(std::size_t points) {
    const double boxes = 64 + static_cast<double>(points) / kPointsInBox;
    double edge = std::max({m_extent[0], m_extent[1], m_extent[2]});
    const auto along = [&](std::size_t axis, double e) {
        return std::floor(m_extent[axis] / e) + 1;
    };
    const auto count = [&](double e) { return along(0, e) * along(1, e) * along(2, e); };
    while (edge > 0 && count(edge / 1.1) <= boxes) edge /= 1.1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        m_cells[axis] = edge > 0 ? static_cast<int>(along(axis, edge)) : 1;
        m_size[axis] = m_extent[axis] / m_cells[axis];
    }
}

int CNeighbourGrid::cellOf(double value, std::size_t axis) const {
    if (!(m_size[axis] > 0)) return 0;
    const double cell = (value - m_low[axis]) / m_size[axis];
    return static_cast<int>(std::clamp<double>(cell, 0, m_cells[axis] - 1));
}

void CNeighbourGrid::scan(
    int x, int y, int s0, int s1, const TPlaceAndScale& to, std::vector<TNeighbour>& found) const {
    const std::size_t last = m_first[flat(x, y, s1) + 1];
    for (std::size_t i = m_first[flat(x, y, s0)]; i < last; ++i) {
        const auto& [point, index] = m_entries[i];
        const double dx = point[0] - to[0];
        const double dy = point[1] - to[1];
        const double ds = point[2] - to[2];
        TNeighbour offered{dx * dx + dy * dy + ds * ds, index};
        if (found.size() == m_count) {
            if (!(offered < found.back())) continue;
            found.pop_back();
        }
        found.insert(std::upper_bound(found.begin(), found.end(), offered), offered);
    }
}

double CNeighbourGrid::reach(const TPlaceAndScale& to, const TCell& centre, int ring) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = to[axis] - m_low[axis];
        if (centre[axis] - ring > 0)
            least = std::min(least, at - (centre[axis] - ring) * m_size[axis]);
        if (centre[axis] + ring + 1 < m_cells[axis])
            least = std::min(least, (centre[axis] + ring + 1) * m_size[axis] - at);
    }
    return least * (1 - 1e-9);  // a point may have been rounded into the next cell
}

void CNeighbourGrid::nearest(const TPlaceAndScale& to, std::vector<TNeighbour>& found) const {
    found.clear();
    const TCell centre{cellOf(to[0], 0), cellOf(to[1], 1), cellOf(to[2], 2)};
    for (int ring = 0;; ++ring) {
        const int s0 = std::max(centre[2] - ring, 0),
                  s1 = std::min(centre[2] + ring, m_cells[2] - 1);
        const int y0 = std::max(centre[1] - ring, 0),
                  y1 = std::min(centre[1] + ring, m_cells[1] - 1);
        const int x0 = std::max(centre[0] - ring, 0),
                  x1 = std::min(centre[0] + ring, m_cells[0] - 1);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                if (std::max(std::abs(x - centre[0]), std::abs(y - centre[1])) == ring) {
                    scan(x, y, s0, s1, to, found);
                    continue;
                }
                if (centre[2] - ring >= 0) scan(x, y, s0, s0, to, found);
                if (centre[2] + ring < m_cells[2]) scan(x, y, s1, s1, to, found);
            }
        const double bound = reach(to, centre, ring);
        if (found.size() == m_count && found.back().distance2 < bound * bound) return;
        if (bound == std::numeric_limits<double>::infinity()) return;  // all cells seen
    }
}

}  // namespace salma::saliency
