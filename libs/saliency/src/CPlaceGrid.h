// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace salma::saliency {

/// Items by place: a grid of square cells over an upright box, each with its list.
template <class ITEM>
class CPlaceGrid {
 public:
    /// Box from (left, top) to (right, bottom) [px]; all finite.
    CPlaceGrid(double left, double top, double right, double bottom) : m_left(left), m_top(top) {
        const double extent = std::max(right - left, bottom - top);
        m_cellSize = std::max(8.0, extent / 1000);  // at most a million cells
        m_columns = cell(right - left) + 1;
        m_rows = cell(bottom - top) + 1;
        m_cells.resize(m_columns * m_rows);
    }

    /// The items of the cell of a place in the box.
    const std::vector<ITEM>& at(double x, double y) const {
        return m_cells[cell(y - m_top) * m_columns + cell(x - m_left)];
    }
    std::vector<ITEM>& at(double x, double y) {
        return m_cells[cell(y - m_top) * m_columns + cell(x - m_left)];
    }

    void clear() {
        for (auto& items : m_cells) items.clear();
    }

    /// Calls `visit(items)` for each cell that may hold places within `radius` of one in the box,
    /// until it returns true; returns whether it did.
    template <class VISIT>
    bool visitAround(double x, double y, double radius, VISIT visit) {
        const std::size_t lastColumn = std::min(cell(x + radius - m_left), m_columns - 1);
        const std::size_t lastRow = std::min(cell(y + radius - m_top), m_rows - 1);
        for (std::size_t row = cell(y - radius - m_top); row <= lastRow; ++row)
            for (std::size_t column = cell(x - radius - m_left); column <= lastColumn; ++column)
                if (visit(m_cells[row * m_columns + column])) return true;
        return false;
    }

 private:
    /// Index of the cell that holds `distance`, 0 for what is before the grid.
    std::size_t cell(double distance) const {
        return static_cast<std::size_t>(std::clamp(distance / m_cellSize, 0.0, 1e6));
    }

    double m_left;
    double m_top;
    double m_cellSize{1};
    std::size_t m_columns{0};
    std::size_t m_rows{0};
    std::vector<std::vector<ITEM>> m_cells;
};

}  // namespace salma::saliency
