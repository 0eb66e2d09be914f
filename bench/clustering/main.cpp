// SPDX-License-Identifier: BSD-3-Clause
// Both clusterers against the loops that one writes first, on the same peaks in the same run.
#include <benchmark/benchmark.h>
#include <salma/saliency/CGreedyClusterer.h>
#include <salma/saliency/CKadirClusterer.h>
#include <salma/saliency/CScaleSaliency.h>

#include <cstdio>
#include <functional>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "plainClustering.h"

namespace {

using namespace salma;
using bench::TRegions;

constexpr auto kPicture = SALMA_SOURCE_DIR "/share/textures/GreatWave.jpg";

/// The first `count` peaks with W > 0.5, by row, of a painting enlarged until it has so many.
TRegions peaksOfPainting(std::size_t count) {
    const cv::Mat painting = cv::imread(kPicture, cv::IMREAD_GRAYSCALE);
    if (painting.empty()) throw std::runtime_error(std::string(kPicture) + ": cannot be read");
    for (double scale = 0.3; scale < 10; scale *= 1.1) {
        cv::Mat picture;
        cv::resize(painting, picture, {}, scale, scale, cv::INTER_AREA);
        TRegions strong;
        for (const auto& peak : saliency::CScaleSaliency().detect(picture))
            if (peak.W > 0.5 && strong.size() < count) strong.push_back(peak);
        if (strong.size() == count) return strong;
    }
    throw std::runtime_error("the painting has too few peaks");
}

/// The console's table, and for the ratios the shortest processor time of each benchmark.
class CTimes : public benchmark::ConsoleReporter {
 public:
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const auto& run : runs)
            if (run.run_type == Run::RT_Iteration) {
                const double time = run.GetAdjustedCPUTime();
                const auto [at, isNew] = m_shortest.emplace(run.run_name.function_name, time);
                if (!isNew && time < at->second) at->second = time;
            }
        ConsoleReporter::ReportRuns(runs);
    }

    void printRatio(const std::string& slow, const std::string& fast) const {
        const auto a = m_shortest.find(slow), b = m_shortest.find(fast);
        if (a == m_shortest.end() || b == m_shortest.end()) return;
        std::printf("%-28s %10.1f times the time of %s\n", slow.c_str(), a->second / b->second,
                    fast.c_str());
    }

 private:
    std::map<std::string, double> m_shortest;
};

void add(const std::string& name,
         const TRegions& peaks,
         const std::function<std::size_t(const TRegions&)>& run) {
    benchmark::RegisterBenchmark(name.c_str(), [peaks, run](benchmark::State& state) {
        std::size_t regions = 0;
        for (auto _ : state) benchmark::DoNotOptimize(regions = run(peaks));
        state.counters["regions"] = static_cast<double>(regions);
    })->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    const saliency::TClusteringOptions options;
    const saliency::CGreedyClusterer greedy(options);
    const saliency::CKadirClusterer kadir(options);
    const std::vector<std::pair<std::string, std::size_t>> sizes{
        {"1k", 1000}, {"10k", 10000}, {"100k", 100000}};
    for (const auto& [name, count] : sizes) {
        const TRegions peaks = peaksOfPainting(count);
        add("greedy/ours/" + name, peaks,
            [&](const TRegions& p) { return greedy.cluster(p).regions.size(); });
        add("greedy/plain/" + name, peaks,
            [&](const TRegions& p) { return bench::plainGreedy(p, options).size(); });
        add("kadir/ours/" + name, peaks,
            [&](const TRegions& p) { return kadir.cluster(p).regions.size(); });
        add("kadir/flann/" + name, peaks,
            [&](const TRegions& p) { return bench::flannKadir(p, options).size(); });
        add("kadir/plain/" + name, peaks,
            [&](const TRegions& p) { return bench::plainKadir(p, options).size(); });
    }
    CTimes times;
    benchmark::RunSpecifiedBenchmarks(&times);
    for (const auto& [name, count] : sizes) {
        times.printRatio("greedy/plain/" + name, "greedy/ours/" + name);
        times.printRatio("kadir/flann/" + name, "kadir/ours/" + name);
        times.printRatio("kadir/plain/" + name, "kadir/ours/" + name);
    }
    return 0;
}
