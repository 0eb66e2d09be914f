// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace salma::saliency {

/// Column, row, scale [px].
using TPlaceAndScale = std::array<double, 3>;

/** Exact nearest neighbours among points in (x, y, s), which are sorted into equal boxes. */
class CNeighbourGrid {
 public:
    /// A neighbour: of equally far ones, that with the smaller index is nearer.
    struct TNeighbour {
        double distance2{0};
        std::size_t index{0};

        bool operator<(const TNeighbour& other) const {
            return distance2 != other.distance2 ? distance2 < other.distance2 : index < other.index;
        }
    };

    /// \param points At least one; finite. \param count Neighbours that will be asked for.
    CNeighbourGrid(const std::vector<TPlaceAndScale>& points, std::size_t count);

    /** The `count` nearest points, nearest first, or all if there are less.
     * \param found Overwritten; kept by the caller so that it need not be allocated each time. */
    void nearest(const TPlaceAndScale& to, std::vector<TNeighbour>& found) const;

    /// The indices of all points, those of one box together.
    std::vector<std::size_t> byPlace() const;

 private:
    using TCell = std::array<int, 3>;

    struct TEntry {
        TPlaceAndScale point;
        std::size_t index;
    };

    void chooseCells(std::size_t points);
    int cellOf(double value, std::size_t axis) const;
    std::size_t flat(int x, int y, int s) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(m_cells[0]) +
                static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(m_cells[2]) +
               static_cast<std::size_t>(s);
    }
    /// Offers the points of the cells (x, y, s0..s1), which lie one after the other.
    void scan(int x,
              int y,
              int s0,
              int s1,
              const TPlaceAndScale& to,
              std::vector<TNeighbour>& found) const;
    /// No point outside of the cells within `ring` of the centre is nearer than this.
    double reach(const TPlaceAndScale& to, const TCell& centre, int ring) const;

    std::size_t m_count;
    TPlaceAndScale m_low{};
    TPlaceAndScale m_extent{};
    TPlaceAndScale m_size{};           // of a cell
    TCell m_cells{};                   // along each axis
    std::vector<std::size_t> m_first;  // first entry of each cell, and one past the last
    std::vector<TEntry> m_entries;     // by cell
};

}  // namespace salma::saliency
