// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/CGreedyClusterer.h>

#include <algorithm>
#include <functional>
#include <iterator>

#include "CPlaceGrid.h"
#include "rankedPeaks.h"

namespace salma::saliency {

using observations::TSalientRegion;

namespace {

/** The discs that were kept, each entered in every cell of a grid that it may touch, so that a
 * point meets only the few discs of its own cell. */
class CDiscs {
 public:
    explicit CDiscs(const TBox& box) : m_grid(box.left, box.top, box.right, box.bottom) {}

    bool cover(const TSalientRegion& point) const {
        const auto& discs = m_grid.at(point.x, point.y);
        return std::any_of(discs.begin(), discs.end(), [&point](const TSalientRegion& disc) {
            const double dx = point.x - disc.x;
            const double dy = point.y - disc.y;
            return dx * dx + dy * dy <= disc.s * disc.s;
        });
    }

    void insert(const TSalientRegion& disc) {
        m_grid.visitAround(disc.x, disc.y, disc.s, [&disc](auto& cell) {
            cell.push_back(disc);
            return false;
        });
    }

    void clear() { m_grid.clear(); }

 private:
    CPlaceGrid<TSalientRegion> m_grid;
};

/// A value that about one in eight of the ranked exceed, from a sample of them; one reaches it.
double upperEighth(const std::vector<TRankedPeak>& ranked) {
    const std::size_t step = ranked.size() / 1024 + 1;
    std::vector<double> sample;
    for (std::size_t i = 0; i < ranked.size(); i += step) sample.push_back(ranked[i].Y);
    const auto at = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 8);
    std::nth_element(sample.begin(), at, sample.end(), std::greater<>());
    return *at;
}

}  // namespace

CGreedyClusterer::CGreedyClusterer(const TClusteringOptions& options) : m_options(options) {
    m_options.validate();
}

/** Most peaks lie in the discs of a few. So the most salient part is sorted and taken first, then
 * those of the rest that it left. */
TClusteredRegions CGreedyClusterer::cluster(const std::vector<TSalientRegion>& peaks) const {
    TClusteredRegions result;
    auto rest = rankedPeaks(peaks, m_options.wMin);
    const std::size_t strong = rest.size();
    result.belowWMin = peaks.size() - strong;
    if (rest.empty()) return result;
    CDiscs kept(boxOf(rest, peaks));
    const auto isCovered = [&](const TRankedPeak& r) { return kept.cover(peaks[r.index]); };
    std::vector<TRankedPeak> first;
    while (!rest.empty()) {
        first.clear();
        const double least = upperEighth(rest);
        const auto isFirst = [least](const TRankedPeak& r) { return r.Y >= least; };
        std::copy_if(rest.begin(), rest.end(), std::back_inserter(first), isFirst);
        sortBySalience(first, peaks);
        for (const auto& r : first) {
            if (isCovered(r)) continue;
            kept.insert(peaks[r.index]);
            result.regions.push_back(peaks[r.index]);
        }
        rest.erase(std::remove_if(rest.begin(), rest.end(),
                                  [&](const auto& r) { return isFirst(r) || isCovered(r); }),
                   rest.end());
        kept.clear();  // none of them covers any of the rest
    }
    result.insideStronger = strong - result.regions.size();
    return result;
}

}  // namespace salma::saliency
