// SPDX-License-Identifier: BSD-3-Clause
// Is the EKF as sure as it should be? NEES of the pose over simulated drives, as the table and the
// plot of docs/association.md.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "CConsistencyStudy.h"

int main(int argc, char** argv) {
    using namespace salma;
    std::size_t runs = 50;
    std::uint32_t seed = 1;
    int laps = 3;
    std::string plot;
    CLI::App app("Consistency of the EKF at three levels of odometry noise");
    app.add_option("--runs", runs, "drives of each level")->check(CLI::PositiveNumber);
    app.add_option("--seed", seed, "of the first drive; the others follow");
    app.add_option("--laps", laps, "of the hallway")->check(CLI::PositiveNumber);
    app.add_option("--plot", plot, "PNG file");
    CLI11_PARSE(app, argc, argv);
    try {
        const bench::CLoopWorld world(laps);
        std::printf("%zu landmarks, %d laps, seeds %u to %zu\n\n", world.landmarks(), laps, seed,
                    seed + runs - 1);
        std::printf(
            "| odometry noise | drift in a lap [m] | filter | mean NEES | 95 %% interval | "
            "steps inside %% | position RMS [m] |\n|---|---|---|---|---|---|---|\n");
        std::vector<bench::TLevelResult> levels;
        for (const auto& level : bench::noiseLevels()) {
            levels.push_back(bench::study(world, level, runs, seed));
            const auto& result = levels.back();
            for (const auto& filter : result.filters)
                std::printf("| %s | %.2f | %s | %.2f | %.2f to %.2f | %.1f | %.3f |\n",
                            level.name.c_str(), result.driftAtClosure, filter.filter.c_str(),
                            filter.meanNees, result.low, result.high, 100 * filter.shareInside,
                            filter.positionRms);
            std::fflush(stdout);
        }
        if (!plot.empty()) bench::plotConsistency(levels, plot);
    } catch (const std::exception& e) {
        std::cerr << "ekf-consistency: " << e.what() << "\n";
        return 1;
    }
}
