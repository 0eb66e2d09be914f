// SPDX-License-Identifier: BSD-3-Clause
// salma-ptz: pan, tilt and zoom of a camera from the shell.
#include <iostream>

#include "CPtzApp.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    CLI::App app("Turns and zooms a VISCA camera (Sony EVI-D30) at a serial port.", "salma-ptz");
    salma::apps::CPtzApp camera(app);
    return salma::apps::runProgram(app,
                                   "  salma-ptz /dev/ttyS0 status\n"
                                   "  salma-ptz /dev/ttyS0 move 20 -5 --speed 30\n",
                                   argc, argv, [&] { camera.run(std::cout); });
}
