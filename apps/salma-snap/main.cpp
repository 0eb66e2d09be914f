// SPDX-License-Identifier: BSD-3-Clause
// salma-snap: pictures from a V4L2 device to files.
#include <iostream>

#include "CSnapApp.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    CLI::App app("Takes single pictures, or one every so often, from a V4L2 device.", "salma-snap");
    salma::apps::CSnapApp snap(app);
    return salma::apps::runProgram(
        app,
        "  salma-snap /dev/video0 --list\n"
        "  salma-snap /dev/video0 --standard PAL --size 768x576 --period 1 --out pictures\n",
        argc, argv, [&] { snap.run(std::cout); });
}
