// SPDX-License-Identifier: BSD-3-Clause
#include "CNearestNeighbours.h"

#include <cmath>
#include <limits>
#include <nanoflann.hpp>

namespace salma::saliency {
namespace {

// NOLINTBEGIN(readability-identifier-naming): nanoflann's names
/// The points as nanoflann reads them.
struct TPoints {
    const std::vector<TPlaceAndScale>& points;

    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t index, std::size_t axis) const { return points[index][axis]; }
    template <class BOX>
    bool kdtree_get_bbox(BOX& /*box*/) const {
        return false;
    }
};
// NOLINTEND(readability-identifier-naming)

/** The nearest so far. nanoflann's own set leaves to chance which of equally far points are in it;
 * this one is offered them, as its worst distance is a little larger than it is. */
class CNearest {
 public:
    CNearest(std::vector<double>& distances, std::vector<std::size_t>& indices)
        : m_distances(distances), m_indices(indices) {
        m_distances.back() = std::numeric_limits<double>::infinity();
    }

    bool full() const { return m_count == m_distances.size(); }
    std::size_t size() const { return m_count; }

    double worstDist() const {
        const double worst = m_distances.back();
        return worst + 1e-9 * worst + std::numeric_limits<double>::min();
    }

    /// True: go on.
    bool addPoint(double distance, std::size_t index) {
        std::size_t i = m_count;
        if (full()) {
            if (!isBefore(distance, index, i - 1)) return true;
            --i;
        } else {
            ++m_count;
        }
        for (; i > 0 && isBefore(distance, index, i - 1); --i) {
            m_distances[i] = m_distances[i - 1];
            m_indices[i] = m_indices[i - 1];
        }
        m_distances[i] = distance;
        m_indices[i] = index;
        return true;
    }

 private:
    bool isBefore(double distance, std::size_t index, std::size_t place) const {
        return distance != m_distances[place] ? distance < m_distances[place]
                                              : index < m_indices[place];
    }

    std::vector<double>& m_distances;
    std::vector<std::size_t>& m_indices;
    std::size_t m_count{0};
};

using TIndex = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, TPoints>,
                                                   TPoints,
                                                   3,
                                                   std::size_t>;

}  // namespace

struct CNearestNeighbours::TTree {
    explicit TTree(const std::vector<TPlaceAndScale>& all)
        : points{all}, index(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}

    TPoints points;
    TIndex index;
};

CNearestNeighbours::CNearestNeighbours(const std::vector<TPlaceAndScale>& points, std::size_t count)
    : m_tree(std::make_unique<TTree>(points)), m_distances(count), m_indices(count) {}

CNearestNeighbours::~CNearestNeighbours() = default;

const std::vector<std::size_t>& CNearestNeighbours::of(const TPlaceAndScale& place) {
    CNearest nearest(m_distances, m_indices);
    m_tree->index.findNeighbors(nearest, place.data(), nanoflann::SearchParams());
    return m_indices;
}

}  // namespace salma::saliency
