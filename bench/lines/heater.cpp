// SPDX-License-Identifier: BSD-3-Clause
// How often the sweep of a nodding laser tells a heater from the wall, as docs/laser.md has it.
#include <CLI/CLI.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <cstdio>

#include "heaterScenes.h"

int main(int argc, char** argv) {
    using namespace salma::laser;
    CLI::App app("Heaters told from walls in simulated sweeps");
    std::uint32_t first = 5001, count = 400;
    app.add_option("--first-seed", first, "seed of the first scene");
    app.add_option("--scenes", count, "number of scenes")->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);
    const CPlaneExtractor extractor;
    double right = 0;
    std::size_t fronts = 0, told = 0, walls = 0, others = 0, false2D = 0;
    for (std::uint32_t seed = first; seed < first + count; ++seed) {
        const auto scene = test::heaterScene({}, seed);
        const auto verdict = judge(scene, extractor.extract(scene.sweep));
        right += verdict.right();
        fronts += verdict.frontFound;
        told += verdict.toldFromWall;
        walls += verdict.wallFound;
        others += verdict.otherProtrusion;
        false2D += verdict.falseWall2D;
        if (!verdict.right()) std::printf("seed %u is wrong\n", seed);
    }
    using Binomial = boost::math::binomial_distribution<>;
    const double n = count;
    std::printf(
        "%u scenes, seeds %u...\nlevel scan: false wall at the heater in %zu\n"
        "sweep: front found %zu, told from the wall %zu, wall found %zu, other protrusions "
        "%zu\nright %.0f = %.2f %% (95 %%: %.2f to %.2f)\n",
        count, first, false2D, fronts, told, walls, others, right, 100 * right / n,
        100 * Binomial::find_lower_bound_on_p(n, right, 0.025),
        100 * Binomial::find_upper_bound_on_p(n, right, 0.025));
}
