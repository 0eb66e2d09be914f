// SPDX-License-Identifier: BSD-3-Clause
#include "CLineSearch.h"

#include "CRansacSearch.h"
#include "CSplitMergeSearch.h"

namespace salma::laser {
namespace {

constexpr int kRegrowths = 6;

}  // namespace

std::unique_ptr<CLineSearch> createLineSearch(const TLineOptions& options,
                                              const CFreePoints& points) {
    if (options.method == ELineMethod::splitMerge)
        return std::make_unique<CSplitMergeSearch>(options, points);
    return std::make_unique<CRansacSearch>(options, points);
}

void settle(const CFreePoints& points, TCandidate& candidate) {
    Members regrown;
    for (int i = 0; i < kRegrowths; ++i) {
        Members& members = candidate.members;
        const auto better = improveLine(candidate.fit, points.beams(), members, points.noise());
        if (!better) return;
        points.collect(*better, members[members.size() / 2], regrown);
        if (regrown.size() < members.size() / 2 || regrown.size() < 3) return;
        candidate.fit = *better;
        const bool same = regrown == members;
        members.swap(regrown);
        if (same) return;
    }
}

}  // namespace salma::laser
