// SPDX-License-Identifier: BSD-3-Clause
// region-repeatability: which share of the regions of one picture is found again in another of the
// plane.
#include <iostream>

#include "CRepeatabilityApp.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    CLI::App app("Measures how well detectors of regions repeat themselves on pictures of a plane.",
                 "region-repeatability");
    salma::bench::CRepeatabilityApp bench(app);
    return salma::apps::runProgram(
        app,
        "  region-repeatability ../shared/data/homography/graf --out out/repeatability\n"
        "  region-repeatability graf boat churchill --strongest 1000 --threads 2 --out "
        "out/repeatability\n",
        argc, argv, [&] { bench.run(std::cout); });
}
