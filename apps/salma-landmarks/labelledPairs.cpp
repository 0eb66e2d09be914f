// SPDX-License-Identifier: BSD-3-Clause
#include "labelledPairs.h"

#include <CProgressBar.h>
#include <parallelFor.h>

namespace salma::apps {
namespace {

EPair kindOf(const TSeenPoster& a, const TSeenPoster& b) {
    if (a.poster == b.poster) return EPair::same;
    return a.texture == b.texture ? EPair::duplicate : EPair::other;
}

TLabelledPair compare(const TLabelledRun& run,
                      std::size_t a,
                      std::size_t b,
                      const appearance::CPatchMatcher& matcher) {
    const TSeenPoster &first = run.seen[a], &second = run.seen[b];
    const auto match = matcher.match(first.patch, second.patch);
    TLabelledPair pair;
    pair.kind = kindOf(first, second);
    pair.a = a;
    pair.b = b;
    pair.textureA = first.texture;
    pair.textureB = second.texture;
    pair.evidence = match.evidence;
    pair.score = match.score;
    pair.keypointScore = match.keypointScore;
    pair.configuredRatio = match.logLikelihoodRatio;
    return pair;
}

}  // namespace

std::vector<TLabelledPair> comparePairs(const TLabelledRun& run,
                                        const appearance::CPatchMatcher& matcher,
                                        int threads) {
    const std::size_t n = run.seen.size();
    std::vector<std::vector<TLabelledPair>> rows(n);
    CProgressBar progress("comparing " + run.folder, n);
    parallelFor(n, threads, [&](std::size_t a) {
        for (std::size_t b = a + 1; b < n; ++b) rows[a].push_back(compare(run, a, b, matcher));
        progress.step();
    });
    std::vector<TLabelledPair> pairs;
    for (const auto& row : rows) pairs.insert(pairs.end(), row.begin(), row.end());
    return pairs;
}

}  // namespace salma::apps
