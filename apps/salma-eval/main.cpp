// SPDX-License-Identifier: BSD-3-Clause
// salma-eval: scores of a run against the truth.
#include <iostream>

#include "CEvalApp.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    CLI::App app(
        "Scores trajectories and data association against the truth, of one run or of many.",
        "salma-eval");
    salma::apps::CEvalApp evaluation(app);
    return salma::apps::runProgram(
        app,
        "  salma-eval trajectory rawlogs/hallway-loop.gt.tum out/hallway/trajectory.tum\n"
        "  salma-eval associations rawlogs out/hallway --name hallway-loop\n",
        argc, argv, [&] { evaluation.run(std::cout); });
}
