// SPDX-License-Identifier: BSD-3-Clause
// evid30-emulator LINK: a camera to try programs on, at the serial port LINK, until Ctrl-C.
#include <iostream>

#include "CEndingSignals.h"
#include "CEviD30.h"

int main(int argc, char** argv) {
    if (argc != 2 || argv[1][0] == '-') {
        std::cerr << "usage: evid30-emulator LINK, e.g. evid30-emulator /tmp/camera\n";
        return 2;
    }
    const salma::test::CEndingSignals ending;
    try {
        salma::test::CEviD30 camera;
        const salma::test::CEmulator emulator(camera, argv[1]);
        std::cout << "an EVI-D30 listens at " << argv[1] << " until Ctrl-C" << std::endl;
        ending.wait();
    } catch (const std::exception& error) {
        std::cerr << "evid30-emulator: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
