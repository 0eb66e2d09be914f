// SPDX-License-Identifier: BSD-3-Clause
// lms200-emulator LINK [WORLD.ini]: a laser to try programs on, at the serial port LINK, until
// Ctrl-C. It stands in a room, or drives through a world of salma-sim, again and again.
#include <cmath>
#include <iostream>
#include <memory>

#include "CEndingSignals.h"
#include "CWorldScanner.h"

using namespace salma;

namespace {

/// Stands 3 m before a wall that has no end.
std::vector<double> beforeAWall(const test::TLmsView& view, double) {
    std::vector<double> ranges;
    for (std::size_t i = 0; i < view.beams(); ++i) {
        const double degrees = static_cast<double>(i) * view.resolution / 100 - view.aperture / 2.0;
        ranges.push_back(3 / std::cos(degrees * M_PI / 180));
    }
    return ranges;
}

test::TLmsScanner scannerFor(int argc, char** argv) {
    if (argc < 3) return beforeAWall;
    const auto world = simulator::loadWorld(argv[2]);
    const auto path = std::make_shared<simulator::CPath>(world.path, 1);
    const double start = test::CEmulator::now();
    const auto scanner = std::make_shared<test::CWorldScanner>(world, 1, [path, start](double now) {
        return path->pose(std::fmod(now - start, path->duration()));
    });
    return [scanner](const test::TLmsView& view, double now) { return scanner->scan(view, now); };
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3 || argv[1][0] == '-') {
        std::cerr << "usage: lms200-emulator LINK [WORLD.ini], e.g. lms200-emulator /tmp/laser\n";
        return 2;
    }
    const test::CEndingSignals ending;
    try {
        test::CSickLms200 laser(scannerFor(argc, argv));
        const test::CEmulator emulator(laser, argv[1]);
        std::cout << "a LMS 200 listens at " << argv[1] << " until Ctrl-C" << std::endl;
        ending.wait();
    } catch (const std::exception& error) {
        std::cerr << "lms200-emulator: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
