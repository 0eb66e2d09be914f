// SPDX-License-Identifier: BSD-3-Clause
// Times of one patch: rectify, describe, match. --benchmark_repetitions=9 gives medians.
#include <benchmark/benchmark.h>
#include <salma/appearance/CPatchDescriptor.h>
#include <salma/appearance/CPatchMatcher.h>
#include <salma/appearance/CRegionDescriptor.h>
#include <salma/appearance/CTexture.h>

#include "CPosterViews.h"

namespace {

using namespace salma;

bench::TPosterView viewOf(const std::string& poster, std::uint32_t index) {
    const auto file = std::string(SALMA_SOURCE_DIR) + "/share/textures/" + poster + ".jpg";
    return bench::CPosterViews(file, "brick", 0.6, 1).view(index);
}

observations::TPatch patchOf(const bench::TPosterView& view) {
    auto patch = appearance::CRectifier().rectify(view.grey, view.seen, view.cut).patch.value();
    patch.keypoints = appearance::CPatchDescriptor().describe(patch);
    patch.regions = appearance::CRegionDescriptor().describe(view.grey, view.seen, view.cut);
    return patch;
}

void rectify(benchmark::State& state) {
    const auto view = viewOf("GreatWave", 1);
    const appearance::CRectifier rectifier;
    for (auto _ : state)
        benchmark::DoNotOptimize(rectifier.rectify(view.grey, view.seen, view.cut));
}
BENCHMARK(rectify)->Unit(benchmark::kMillisecond);

void describeKeypoints(benchmark::State& state) {
    const auto patch = patchOf(viewOf("GreatWave", 1));
    const appearance::CPatchDescriptor descriptor;
    for (auto _ : state) benchmark::DoNotOptimize(descriptor.describe(patch));
}
BENCHMARK(describeKeypoints)->Unit(benchmark::kMillisecond);

void describeRegions(benchmark::State& state) {
    const auto view = viewOf("GreatWave", 1);
    const appearance::CRegionDescriptor descriptor;
    for (auto _ : state)
        benchmark::DoNotOptimize(descriptor.describe(view.grey, view.seen, view.cut));
}
BENCHMARK(describeRegions)->Unit(benchmark::kMillisecond);

void describeTexture(benchmark::State& state) {
    const auto view = viewOf("GreatWave", 1);
    const appearance::CTexture texture;
    for (auto _ : state) benchmark::DoNotOptimize(texture.describe(view.grey, view.seen, view.cut));
}
BENCHMARK(describeTexture)->Unit(benchmark::kMillisecond);

void match(benchmark::State& state, const std::string& other) {
    const auto a = patchOf(viewOf("GreatWave", 1)), b = patchOf(viewOf(other, 2));
    const appearance::CPatchMatcher matcher;
    for (auto _ : state) benchmark::DoNotOptimize(matcher.match(a, b));
}
BENCHMARK_CAPTURE(match, samePoster, std::string("GreatWave"))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(match, otherPoster, std::string("EjiriSuruga"))->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
