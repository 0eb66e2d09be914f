// SPDX-License-Identifier: BSD-3-Clause
// What a place costs for each scan: lines, string, distance of two strings, class. The distance is
// raced against the matrix that one writes first, on the same strings.
#include <benchmark/benchmark.h>
#include <salma/laser/CPlaceClassifier.h>
#include <salma/laser/CPlaceDistance.h>
#include <salma/laser/CPlaceString.h>

#include <algorithm>
#include <limits>

#include "TPlaceSample.h"

namespace {

using namespace salma;
using observations::TPlaceLetter;
using observations::TPlaceString;

struct TWork {
    std::vector<bench::TPlaceSample> samples;
    std::vector<laser::TLineResult> lines;
    std::vector<TPlaceString> strings;
};

const TWork& work() {
    static const TWork kept = [] {
        TWork w;
        w.samples = bench::drawWalk(bench::validationBuildings(), 3001, 256);
        for (const auto& s : w.samples) {
            w.lines.push_back(laser::CLineExtractor().extract(s.scan));
            w.strings.push_back(laser::CPlaceString().describe(s.scan, w.lines.back()));
        }
        return w;
    }();
    return kept;
}

/// The same distance with a whole matrix of vectors; every cost is asked where it is used.
double plainDistance(const laser::CPlaceDistance& d, const TPlaceString& a, const TPlaceString& b) {
    const std::size_t m = a.size(), n = b.size();
    const auto f =
        static_cast<std::size_t>(d.options().freeShare * static_cast<double>(std::min(m, n)));
    std::vector<std::vector<double>> cost(m + 1, std::vector<double>(n + 1, 0));
    double total = 0, best = std::numeric_limits<double>::infinity();
    for (const TPlaceLetter& l : a) total += d.gapCost(l);
    for (const TPlaceLetter& l : b) total += d.gapCost(l);
    if (!(total > 0)) return 0;
    for (std::size_t i = 1; i <= m; ++i)
        cost[i][0] = i <= f ? 0 : cost[i - 1][0] + d.gapCost(a[i - 1]);
    for (std::size_t j = 1; j <= n; ++j)
        cost[0][j] = j <= f ? 0 : cost[0][j - 1] + d.gapCost(b[j - 1]);
    for (std::size_t i = 1; i <= m; ++i)
        for (std::size_t j = 1; j <= n; ++j)
            cost[i][j] = std::min(
                {cost[i - 1][j] + d.gapCost(a[i - 1]), cost[i][j - 1] + d.gapCost(b[j - 1]),
                 cost[i - 1][j - 1] + laser::CPlaceDistance::changeCost(a[i - 1], b[j - 1])});
    for (std::size_t i = m - std::min(m, f); i <= m; ++i) best = std::min(best, cost[i][n]);
    for (std::size_t j = n - std::min(n, f); j <= n; ++j) best = std::min(best, cost[m][j]);
    return std::min(best / total, 1.0);
}

/// Runs `one(i)` for i over all scans, again and again; the time is that of one.
template <class ONE>
void each(benchmark::State& state, const ONE& one) {
    std::size_t i = 0;
    const std::size_t n = work().samples.size();
    for (auto _ : state) {
        one(i);
        i = (i + 1) % n;
    }
}

void lines(benchmark::State& state) {
    const laser::CLineExtractor extractor;
    each(state, [&](std::size_t i) {
        benchmark::DoNotOptimize(extractor.extract(work().samples[i].scan));
    });
}
BENCHMARK(lines)->Unit(benchmark::kMicrosecond);

void string(benchmark::State& state) {
    const laser::CPlaceString reader;
    each(state, [&](std::size_t i) {
        benchmark::DoNotOptimize(reader.describe(work().samples[i].scan, work().lines[i]));
    });
}
BENCHMARK(string)->Unit(benchmark::kMicrosecond);

template <class DISTANCE>
void pairs(benchmark::State& state, const DISTANCE& distance) {
    const auto& s = work().strings;
    each(state, [&](std::size_t i) {
        benchmark::DoNotOptimize(distance(s[i], s[(7 * i + 31) % s.size()]));
    });
}

void distancePlain(benchmark::State& state) {
    const laser::CPlaceDistance d;
    pairs(state, [&](const auto& a, const auto& b) { return plainDistance(d, a, b); });
}
BENCHMARK(distancePlain);

void distanceOurs(benchmark::State& state) {
    const laser::CPlaceDistance d;
    pairs(state, [&](const auto& a, const auto& b) { return d(a, b); });
}
BENCHMARK(distanceOurs);

void distanceWithLimit(benchmark::State& state) {
    const laser::CPlaceDistance d;
    pairs(state, [&](const auto& a, const auto& b) { return d(a, b, 0.2); });
}
BENCHMARK(distanceWithLimit);

void classify(benchmark::State& state) {
    const laser::CPlaceClassifier classifier;
    each(state, [&](std::size_t i) {
        benchmark::DoNotOptimize(classifier.classify(work().samples[i].scan));
    });
}
BENCHMARK(classify)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
