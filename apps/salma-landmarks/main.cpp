// SPDX-License-Identifier: BSD-3-Clause
// salma-landmarks: what a robot remembers of the posters it saw.
#include <iostream>

#include "CCalibrateCommand.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    CLI::App app("Works on salient landmarks: their appearance and how far it can be trusted.",
                 "salma-landmarks");
    app.require_subcommand(1);
    salma::apps::CCalibrateCommand calibrate(app);
    return salma::apps::runProgram(
        app,
        "  salma-landmarks calibrate out/learn-1 out/learn-2 --out out/calibration\n"
        "  salma-landmarks calibrate out/learn-1 --report out/report-1 --out out/calibration\n",
        argc, argv, [&] {
            if (calibrate.isChosen()) calibrate.run(std::cout);
        });
}
