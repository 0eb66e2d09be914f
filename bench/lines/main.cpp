// SPDX-License-Identifier: BSD-3-Clause
// Races the ways to find lines in scans of 361 readings, and counts false and missed lines on
// simulated ones. Options of Google Benchmark; --benchmark_filter=NONE for the table alone.
#include <benchmark/benchmark.h>
#include <mrpt/math/ransac_applications.h>
#include <salma/observations/readCarmenLog.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>

#include "qualityTable.h"
#include "simulatedScans.h"

namespace {

using namespace salma;
using Scans = std::vector<mrpt::obs::CObservation2DRangeScan>;

Scans simulated() {
    Scans scans;
    for (std::uint32_t seed = 1001; seed < 1009; ++seed)
        for (const auto& s : laser::test::simulatedScans({}, seed, 25)) scans.push_back(s.scan);
    return scans;
}

/// Every tenth scan of a real office; none where the log is not here.
Scans real() {
    Scans scans;
    const std::string file = std::string(SALMA_DATA_DIR) + "/laser/mit-csail.clf.bz2";
    if (!std::filesystem::exists(file)) return scans;
    const auto log = observations::readCarmenLog(file);
    for (std::size_t i = 0; i < log.scans.size(); i += 10) scans.push_back(*log.scans[i].scan);
    return scans;
}

void runOurs(benchmark::State& state, laser::ELineMethod method, const Scans& scans) {
    laser::TLineOptions options;
    options.method = method;
    const laser::CLineExtractor extractor(options);
    std::size_t lines = 0;
    for (auto _ : state) {
        lines = 0;
        for (const auto& scan : scans) lines += extractor.extract(scan).lines.size();
        benchmark::DoNotOptimize(lines);
    }
    const auto count = static_cast<double>(scans.size());
    state.counters["lines"] = static_cast<double>(lines) / count;
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * scans.size()));
}

/// Lines without ends, order or covariance, in points that are there already: less work.
void runMrpt(benchmark::State& state, const Scans& scans) {
    const laser::TLineOptions options;
    std::vector<std::pair<mrpt::math::CVectorDouble, mrpt::math::CVectorDouble>> points;
    for (const auto& scan : scans) {
        std::vector<double> x, y;
        const double step = scan.aperture / static_cast<double>(scan.getScanSize() - 1);
        for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
            if (!scan.getScanRangeValidity(i)) continue;
            const double bearing = step * static_cast<double>(i) - scan.aperture / 2;
            x.push_back(scan.getScanRange(i) * std::cos(bearing));
            y.push_back(scan.getScanRange(i) * std::sin(bearing));
        }
        const auto n = static_cast<Eigen::Index>(x.size());
        points.emplace_back();
        points.back().first = Eigen::Map<const Eigen::VectorXd>(x.data(), n);
        points.back().second = Eigen::Map<const Eigen::VectorXd>(y.data(), n);
    }
    std::cout.setstate(std::ios::badbit);  // MRPT tells of each line that it found
    std::size_t lines = 0, next = 0, done = 0;
    for (auto _ : state) {
        std::vector<std::pair<std::size_t, mrpt::math::TLine2D>> found;
        const auto& [x, y] = points[next];
        mrpt::math::ransac_detect_2D_lines(x, y, found, options.inlier,
                                           static_cast<std::size_t>(options.minPoints));
        next = (next + 1) % points.size();
        lines += found.size();
        ++done;
    }
    std::cout.clear();
    state.counters["lines"] = static_cast<double>(lines) / static_cast<double>(done);
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}

/// Prints as usual, and keeps the rates.
class CRates : public benchmark::ConsoleReporter {
 public:
    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs) {
            const auto rate = run.counters.find("items_per_second");
            if (rate != run.counters.end()) m_rates[run.benchmark_name()] = rate->second.value;
        }
    }
    void printRatios(const std::string& scans) const {
        const auto ransac = m_rates.find("ransac/" + scans);
        if (ransac == m_rates.end()) return;
        std::printf("%s: RANSAC %.1f kHz", scans.c_str(), ransac->second / 1000);
        for (const std::string other : {"split_merge", "mrpt"}) {
            const auto rate = m_rates.find(other + "/" + scans);
            if (rate != m_rates.end())
                std::printf(", %.2f times %s", ransac->second / rate->second, other.c_str());
        }
        std::printf("\n");
    }

 private:
    std::map<std::string, double> m_rates;
};

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    const std::map<std::string, Scans> sets{{"simulated", simulated()}, {"mit-csail", real()}};
    for (const auto& [name, scans] : sets) {
        if (scans.empty()) {
            std::printf("%s: not here, left out\n", name.c_str());
            continue;
        }
        const Scans& set = scans;
        benchmark::RegisterBenchmark(("ransac/" + name).c_str(), [&set](benchmark::State& s) {
            runOurs(s, laser::ELineMethod::ransac, set);
        });
        benchmark::RegisterBenchmark(("split_merge/" + name).c_str(), [&set](benchmark::State& s) {
            runOurs(s, laser::ELineMethod::splitMerge, set);
        });
        benchmark::RegisterBenchmark(("mrpt/" + name).c_str(),
                                     [&set](benchmark::State& s) { runMrpt(s, set); });
    }
    CRates rates;
    benchmark::RunSpecifiedBenchmarks(&rates);
    for (const auto& [name, scans] : sets) rates.printRatios(name);
    bench::printQuality();
}
