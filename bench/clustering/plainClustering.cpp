// SPDX-License-Identifier: BSD-3-Clause
#include "plainClustering.h"

#include <algorithm>
#include <opencv2/flann.hpp>
#include <tuple>
#include <utility>

namespace salma::bench {

using observations::TSalientRegion;
using saliency::TClusteringOptions;

namespace {

double square(double value) { return value * value; }

double distance2(const TSalientRegion& a, const TSalientRegion& b) {
    return square(a.x - b.x) + square(a.y - b.y) + square(a.s - b.s);
}

TRegions strongest(TRegions peaks, double wMin) {
    peaks.erase(
        std::remove_if(peaks.begin(), peaks.end(), [wMin](const auto& p) { return !(p.W > wMin); }),
        peaks.end());
    std::sort(peaks.begin(), peaks.end(), [](const auto& a, const auto& b) {
        return std::make_tuple(-a.Y, a.y, a.x, a.s) < std::make_tuple(-b.Y, b.y, b.x, b.s);
    });
    return peaks;
}

/// Kadir's clustering, whose neighbours come from `nearest(peak, indices)`.
template <class NEAREST>
TRegions kadir(const TRegions& sorted, const TClusteringOptions& options, NEAREST nearest) {
    TRegions regions;
    std::vector<std::size_t> members(static_cast<std::size_t>(options.neighbours));
    const auto n = static_cast<double>(members.size());
    if (sorted.size() < members.size()) return regions;
    for (const auto& peak : sorted) {
        nearest(peak, members);
        TSalientRegion mean{0, 0, 0, peak.H, peak.W, peak.Y};
        for (const std::size_t m : members) {
            mean.x += sorted[m].x;
            mean.y += sorted[m].y;
            mean.s += sorted[m].s;
        }
        mean.x /= n;
        mean.y /= n;
        mean.s /= n;
        double variance = 0;
        for (const std::size_t m : members) variance += distance2(sorted[m], mean) / n;
        if (variance > options.maxVariance) continue;
        if (std::none_of(regions.begin(), regions.end(),
                         [&mean](const auto& r) { return distance2(r, mean) <= square(mean.s); }))
            regions.push_back(mean);
    }
    return regions;
}

}  // namespace

TRegions plainGreedy(TRegions peaks, const TClusteringOptions& options) {
    TRegions regions;
    for (const auto& p : strongest(std::move(peaks), options.wMin))
        if (std::none_of(regions.begin(), regions.end(), [&p](const auto& r) {
                return square(p.x - r.x) + square(p.y - r.y) <= square(r.s);
            }))
            regions.push_back(p);
    return regions;
}

TRegions plainKadir(TRegions peaks, const TClusteringOptions& options) {
    const TRegions sorted = strongest(std::move(peaks), options.wMin);
    std::vector<std::pair<double, std::size_t>> all(sorted.size());
    return kadir(sorted, options, [&](const TSalientRegion& peak, auto& members) {
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = {distance2(sorted[i], peak), i};
        const auto end = all.begin() + static_cast<std::ptrdiff_t>(members.size());
        std::nth_element(all.begin(), end - 1, all.end());
        std::sort(all.begin(), end);
        for (std::size_t k = 0; k < members.size(); ++k) members[k] = all[k].second;
    });
}

TRegions flannKadir(TRegions peaks, const TClusteringOptions& options) {
    const TRegions sorted = strongest(std::move(peaks), options.wMin);
    cv::Mat1f points(static_cast<int>(sorted.size()), 3);
    for (int i = 0; i < points.rows; ++i) {
        const auto& p = sorted[static_cast<std::size_t>(i)];
        points(i, 0) = static_cast<float>(p.x);
        points(i, 1) = static_cast<float>(p.y);
        points(i, 2) = static_cast<float>(p.s);
    }
    cv::flann::GenericIndex<cv::flann::L2_Simple<float>> index(
        points, cvflann::KDTreeSingleIndexParams(16));
    const cvflann::SearchParams exact(cvflann::FLANN_CHECKS_UNLIMITED);
    std::vector<int> indices(static_cast<std::size_t>(options.neighbours));
    std::vector<float> distances(indices.size());
    return kadir(sorted, options, [&](const TSalientRegion& peak, auto& members) {
        const std::vector<float> place{static_cast<float>(peak.x), static_cast<float>(peak.y),
                                       static_cast<float>(peak.s)};
        index.knnSearch(place, indices, distances, options.neighbours, exact);
        std::copy(indices.begin(), indices.end(), members.begin());
    });
}

}  // namespace salma::bench
