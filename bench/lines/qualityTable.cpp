// SPDX-License-Identifier: BSD-3-Clause
#include "qualityTable.h"

#include <array>
#include <cstdio>

#include "simulatedScans.h"

namespace salma::bench {
namespace {

using laser::test::TLineScore;
using laser::test::TRequired;

constexpr std::uint32_t kFirstSeed = 1001;  // tuned on 1 to 40
constexpr std::uint32_t kBuildings = 40;
constexpr std::size_t kScansEach = 25;
constexpr std::array<TRequired, 3> kRequired{{{9, 0.5}, {6, 0.1}, {4, 0.05}}};

void printRow(laser::ELineMethod method,
              simulator::EResolution resolution,
              simulator::ELaserMode mode) {
    simulator::TLaserOptions laserOptions;
    laserOptions.resolution = resolution;
    laserOptions.mode = mode;
    laser::TLineOptions options;
    options.method = method;
    options.rangeQuantum = laserOptions.quantum();
    const laser::CLineExtractor extractor(options);
    std::array<TLineScore, kRequired.size()> scores;
    for (std::uint32_t seed = kFirstSeed; seed < kFirstSeed + kBuildings; ++seed)
        for (const auto& s : laser::test::simulatedScans(laserOptions, seed, kScansEach)) {
            const auto lines = extractor.extract(s.scan);
            const auto truth = laser::test::trueLines(s.walls, s.hits, s.scan, options);
            for (std::size_t k = 0; k < kRequired.size(); ++k)
                addScore(lines, truth, kRequired[k], scores[k]);
        }
    std::printf("| %s | %zu, %s |", method == laser::ELineMethod::ransac ? "RANSAC" : "split-merge",
                laserOptions.beams(), mode == simulator::ELaserMode::mm ? "mm" : "cm");
    for (const TLineScore& score : scores)
        std::printf(" %zu | %.2f | %.2f |", score.required, 100 * score.falsePart(),
                    100 * score.missedPart());
    std::printf("\n");
    std::fflush(stdout);
}

}  // namespace

void printQuality() {
    std::printf("\n%zu scans each from %u buildings, seeds %u...\n\n| method | scan |",
                kBuildings * kScansEach, kBuildings, kFirstSeed);
    for (const TRequired& r : kRequired)
        std::printf(" lines of >= %zu points, %.2f m | false %% | missed %% |", r.points, r.length);
    std::printf("\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const auto method : {laser::ELineMethod::ransac, laser::ELineMethod::splitMerge})
        for (const auto resolution : {simulator::EResolution::half, simulator::EResolution::one})
            for (const auto mode : {simulator::ELaserMode::mm, simulator::ELaserMode::cm})
                printRow(method, resolution, mode);
}

}  // namespace salma::bench
