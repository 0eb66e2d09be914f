// SPDX-License-Identifier: BSD-3-Clause
// robot-emulator FOLDER WORLD.ini: a robot to try grabbers on. It drives as soon as somebody looks
// at its pictures; Ctrl-C ends it and leaves the truth in FOLDER/drive.gt.tum.
#include <csignal>
#include <iostream>

#include "CEmulatedDrive.h"

int main(int argc, char** argv) {
    if (argc != 3 || argv[1][0] == '-') {
        std::cerr << "usage: robot-emulator FOLDER WORLD.ini, e.g. robot-emulator /tmp/robot "
                     "share/worlds/corridor-20x3.ini\n";
        return 2;
    }
    sigset_t ending;
    sigemptyset(&ending);
    sigaddset(&ending, SIGINT);
    sigaddset(&ending, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &ending, nullptr);  // before the threads, which inherit
    try {
        const std::filesystem::path folder = std::filesystem::absolute(argv[1]);
        std::filesystem::create_directories(folder);
        std::cout << "drawing its pictures ..." << std::endl;
        salma::test::CEmulatedDrive robot(salma::simulator::loadWorld(argv[2]), 1, folder, 7);
        std::cout << "ready: salma-grab " << (folder / "robot.ini").string() << std::endl;
        timespec second{1, 0};
        bool told = false;
        while (sigtimedwait(&ending, nullptr, &second) < 0) {
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
