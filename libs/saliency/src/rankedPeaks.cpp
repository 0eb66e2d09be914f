// SPDX-License-Identifier: BSD-3-Clause
#include "rankedPeaks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

namespace salma::saliency {

using observations::TSalientRegion;

namespace {

constexpr double kLargest = 1e9;  // [px], so that no sum of squares overflows

}  // namespace

std::vector<TRankedPeak> rankedPeaks(const std::vector<TSalientRegion>& peaks, double wMin) {
    std::vector<TRankedPeak> ranked;
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        const TSalientRegion& peak = peaks[i];
        if (!(std::abs(peak.x) + std::abs(peak.y) + std::abs(peak.s) < kLargest &&
              std::isfinite(peak.Y)))
            throw std::invalid_argument("clustering: the position, scale or Y of peak " +
                                        std::to_string(i) + " is not finite, or beyond 1e9 px");
        if (peak.W > wMin) ranked.push_back({peak.Y, i});
    }
    return ranked;
}

TBox boxOf(const std::vector<TRankedPeak>& ranked, const std::vector<TSalientRegion>& peaks) {
    const TSalientRegion& first = peaks[ranked[0].index];
    TBox box{first.x, first.y, first.x, first.y};
    for (const auto& r : ranked) {
        const TSalientRegion& peak = peaks[r.index];
        box.left = std::min(box.left, peak.x);
        box.top = std::min(box.top, peak.y);
        box.right = std::max(box.right, peak.x);
        box.bottom = std::max(box.bottom, peak.y);
    }
    return box;
}

void sortBySalience(std::vector<TRankedPeak>& ranked, const std::vector<TSalientRegion>& peaks) {
    std::sort(ranked.begin(), ranked.end(), [&peaks](const TRankedPeak& a, const TRankedPeak& b) {
        if (a.Y != b.Y) return a.Y > b.Y;
        const TSalientRegion& p = peaks[a.index];
        const TSalientRegion& q = peaks[b.index];
        return std::tie(p.y, p.x, p.s) < std::tie(q.y, q.x, q.s);
    });
}

}  // namespace salma::saliency
