// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace salma::saliency {

/// Column, row, scale [px].
using TPlaceAndScale = std::array<double, 3>;

/// Exact nearest neighbours among points in (x, y, s), by a kd-tree.
class CNearestNeighbours {
 public:
    /// \param points Finite; kept by the caller. \param count Neighbours to find, at most as many
    /// as there are points.
    CNearestNeighbours(const std::vector<TPlaceAndScale>& points, std::size_t count);
    ~CNearestNeighbours();

    /// Indices of the nearest points, nearest first; of equally far ones, the smaller index first.
    /// The result is valid until the next call.
    const std::vector<std::size_t>& of(const TPlaceAndScale& place);

 private:
    struct TTree;
    std::unique_ptr<TTree> m_tree;
    std::vector<double> m_distances;  // squared [px^2]
    std::vector<std::size_t> m_indices;
};

}  // namespace salma::saliency
