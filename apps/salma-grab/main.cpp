// SPDX-License-Identifier: BSD-3-Clause
// salma-grab: sensors to a rawlog, of which nothing is lost.
#include <iostream>

#include "CGrabApp.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    CLI::App app("Records the sensors of a rawlog-grabber ini file and loses nothing.",
                 "salma-grab");
    salma::apps::CGrabApp grab(app);
    return salma::apps::runProgram(app,
                                   "  salma-grab robot.ini --out out/drive.rawlog\n"
                                   "  salma-grab --repair out/drive.rawlog\n",
                                   argc, argv, [&] { grab.run(std::cout); });
}
