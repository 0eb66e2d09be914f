// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "edgePieces.h"

namespace salma::calibration {

/// Column and row in a lattice, counted from where it was begun.
using TNode = std::pair<int, int>;

/** Corners where pieces of edges meet, joined by the pieces into a lattice of columns and rows.
 *
 * Grown from the corner that most pieces meet at, for every corner that was not reached before; the
 * largest lattice counts. */
class CLattice {
 public:
    explicit CLattice(const std::vector<TEdgePiece>& pieces);

    /// Rough places of the corners [px].
    const std::map<TNode, mrpt::math::TPoint2D>& nodes() const { return m_nodes; }

    /// Pieces between neighbours, from the node of the smaller column or row: [0] along a row, [1]
    /// along a column.
    const std::map<TNode, std::size_t>& pieces(int axis) const {
        return m_pieces[static_cast<std::size_t>(axis)];
    }

 private:
    struct TJoint {
        std::size_t corner;
        std::size_t piece;
    };
    struct TGrowth;

    void findCorners(const std::vector<TEdgePiece>& pieces);
    void join(const std::vector<TEdgePiece>& pieces);
    TGrowth grow(std::size_t seed, std::vector<bool>& reached) const;

    std::vector<mrpt::math::TPoint2D> m_corners;
    std::vector<std::vector<TJoint>> m_joints;  //!< Of each corner: the others that pieces lead to.
    std::map<TNode, mrpt::math::TPoint2D> m_nodes;
    std::array<std::map<TNode, std::size_t>, 2> m_pieces;
};

}  // namespace salma::calibration
