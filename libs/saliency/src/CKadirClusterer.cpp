// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/CKadirClusterer.h>

#include <algorithm>

#include "CNearestNeighbours.h"
#include "CPlaceGrid.h"
#include "rankedPeaks.h"

namespace salma::saliency {

using observations::TSalientRegion;

namespace {

double square(double value) { return value * value; }

double distance2(const TPlaceAndScale& a, const TPlaceAndScale& b) {
    return square(a[0] - b[0]) + square(a[1] - b[1]) + square(a[2] - b[2]);
}

/// Where a cluster lies.
struct TCluster {
    TPlaceAndScale mean{};
    double variance{0};  // [px^2]
};

TCluster clusterOf(const std::vector<std::size_t>& members,
                   const std::vector<TPlaceAndScale>& points) {
    TCluster cluster;
    const auto n = static_cast<double>(members.size());
    for (const std::size_t m : members)
        for (std::size_t axis = 0; axis < 3; ++axis) cluster.mean[axis] += points[m][axis];
    for (double& coordinate : cluster.mean) coordinate /= n;
    for (const std::size_t m : members) cluster.variance += distance2(points[m], cluster.mean);
    cluster.variance /= n;
    return cluster;
}

/// The cluster of each point, whatever becomes of it. Points are looked at in the order of
/// `places`.
std::vector<TCluster> clustersOf(const std::vector<TPlaceAndScale>& points,
                                 const std::vector<std::size_t>& places,
                                 std::size_t count) {
    CNearestNeighbours nearest(points, count);
    std::vector<TCluster> clusters(points.size());
    for (const std::size_t i : places) clusters[i] = clusterOf(nearest.of(points[i]), points);
    return clusters;
}

/// Ranks in the order of the peaks' own list: the detector's goes row by row, so that neighbours
/// follow each other and meet in the processor's cache.
std::vector<std::size_t> byPlace(const std::vector<TRankedPeak>& ranked, std::size_t peaks) {
    constexpr auto kNone = static_cast<std::size_t>(-1);
    std::vector<std::size_t> ranks(peaks, kNone);
    for (std::size_t i = 0; i < ranked.size(); ++i) ranks[ranked[i].index] = i;
    ranks.erase(std::remove(ranks.begin(), ranks.end(), kNone), ranks.end());
    return ranks;
}

/// The regions so far.
class CRegions {
 public:
    explicit CRegions(const TBox& box) : m_grid(box.left, box.top, box.right, box.bottom) {}

    /// Whether one lies within the scale of this place, in (x, y, s).
    bool nearOne(const TPlaceAndScale& place) {
        const double limit = square(place[2]);
        return m_grid.visitAround(place[0], place[1], place[2], [&](const auto& cell) {
            return std::any_of(cell.begin(), cell.end(), [&](const TPlaceAndScale& region) {
                return distance2(region, place) <= limit;
            });
        });
    }

    void insert(const TPlaceAndScale& place) { m_grid.at(place[0], place[1]).push_back(place); }

 private:
    CPlaceGrid<TPlaceAndScale> m_grid;
};

}  // namespace

CKadirClusterer::CKadirClusterer(const TClusteringOptions& options) : m_options(options) {
    m_options.validate();
}

TClusteredRegions CKadirClusterer::cluster(const std::vector<TSalientRegion>& peaks) const {
    TClusteredRegions result;
    auto ranked = rankedPeaks(peaks, m_options.wMin);
    result.belowWMin = peaks.size() - ranked.size();
    const auto count = static_cast<std::size_t>(m_options.neighbours);
    if (ranked.size() < count) {
        result.scattered = ranked.size();
        return result;
    }
    sortBySalience(ranked, peaks);
    std::vector<TPlaceAndScale> points;
    points.reserve(ranked.size());
    for (const auto& r : ranked) {
        const TSalientRegion& peak = peaks[r.index];
        points.push_back({peak.x, peak.y, peak.s});
    }
    const auto clusters = clustersOf(points, byPlace(ranked, peaks.size()), count);
    CRegions kept(boxOf(ranked, peaks));
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const TCluster& cluster = clusters[i];
        if (!(cluster.variance <= m_options.maxVariance)) {
            ++result.scattered;
        } else if (kept.nearOne(cluster.mean)) {
            ++result.insideStronger;
        } else {
            kept.insert(cluster.mean);
            const TSalientRegion& peak = peaks[ranked[i].index];
            const auto& [x, y, s] = cluster.mean;
            result.regions.push_back({x, y, s, peak.H, peak.W, peak.Y});
        }
    }
    return result;
}

}  // namespace salma::saliency
