// SPDX-License-Identifier: BSD-3-Clause
// robot-emulator FOLDER WORLD.ini: a robot to try grabbers on. It drives as soon as somebody looks
// at its pictures; Ctrl-C ends it and leaves the truth in FOLDER/drive.gt.tum.
#include <iostream>

#include "CEmulatedDrive.h"
#include "CEndingSignals.h"

int main(int argc, char** argv) {
    if (argc != 3 || argv[1][0] == '-') {
        std::cerr << "usage: robot-emulator FOLDER WORLD.ini, e.g. robot-emulator /tmp/robot "
                     "share/worlds/corridor-20x3.ini\n";
        return 2;
    }
    const salma::test::CEndingSignals ending;
    try {
        const std::filesystem::path folder = std::filesystem::absolute(argv[1]);
        std::filesystem::create_directories(folder);
        std::cout << "drawing its pictures ..." << std::endl;
        salma::test::CEmulatedDrive robot(salma::simulator::loadWorld(argv[2]), 1, folder, 7);
        std::cout << "ready: salma-grab " << (folder / "robot.ini").string() << std::endl;
        bool told = false;
        while (!ending.comeWithinASecond()) {
            if (told || !robot.arrived()) continue;
            std::cout << "it has arrived; Ctrl-C ends" << std::endl;
            told = true;
        }
        robot.writeTruth(folder / "drive.gt.tum");
    } catch (const std::exception& error) {
        std::cerr << "robot-emulator: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
