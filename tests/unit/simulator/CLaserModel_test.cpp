// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <salma/simulator/CLaserModel.h>

#include <algorithm>
#include <cmath>

#include "room.h"

namespace salma::simulator {
namespace {

using mrpt::math::TPose2D;
using test::CTemporaryFolder;

/// Distance from inside the room of room.h to its wall in direction `angle`.
double toWall(double x, double y, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double alongX = c > 0 ? (4 - x) / c : (-2 - x) / c;
    const double alongY = s > 0 ? (1.5 - y) / s : (-1.5 - y) / s;
    return std::min(alongX, alongY);
}

TWorld quiet(const CTemporaryFolder& folder, const std::string& more = {}) {
    TWorld world = load(folder, roomIni(more));
    world.laser.noise = 0;
    world.laser.maxOffset = 0;
    return world;
}

TEST(CLaserModel, MeasuresTheDistanceToTheWallsOfARoom) {
    const CTemporaryFolder folder;
    const TWorld world = quiet(folder);
    const CLaserModel laser(world.laser, CWorld(world), 1);
    const TPose2D robot(0.3, -0.4, 0.7);
    const auto ranges = laser.trueRanges(robot);
    ASSERT_EQ(ranges.size(), 361u);
    const double x = robot.x + 0.18 * std::cos(0.7), y = robot.y + 0.18 * std::sin(0.7);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const double bearing = (static_cast<double>(i) * 0.5 - 90) * M_PI / 180;
        EXPECT_NEAR(ranges[i], toWall(x, y, 0.7 + bearing), 1e-9) << i;
    }
}

TEST(CLaserModel, MrptPutsItsPointsOnTheWalls) {
    const CTemporaryFolder folder;
    const TWorld world = quiet(folder);
    const CLaserModel laser(world.laser, CWorld(world), 1);
    const TPose2D robot(0.5, 0.2, -0.3);
    mrpt::maps::CSimplePointsMap map;
    map.insertionOptions.minDistBetweenLaserPoints = 0;
    const mrpt::poses::CPose3D pose(robot.x, robot.y, 0, robot.phi, 0, 0);
    ASSERT_TRUE(map.insertObservation(laser.scan(robot, 0), pose));
    ASSERT_GT(map.size(), 300u);
    for (std::size_t i = 0; i < map.size(); ++i) {
        float x = 0, y = 0, z = 0;
        map.getPoint(i, x, y, z);
        const double off =
            std::min({std::abs(x - 4.0), std::abs(x + 2.0), std::abs(1.5 - std::abs(y))});
        EXPECT_LT(std::abs(off), 0.0006 + 0.02) << x << " " << y;  // corners mix
        EXPECT_NEAR(z, 0.4, 1e-6);
    }
}

TEST(CLaserModel, SeesABoxOnlyIfItReachesTheBeam) {
    const CTemporaryFolder folder;
    const std::string box = "[box_b]\ncentre_m = 2 0\nlength_m = 1\ndepth_m = 1\ntop_m = ";
    const TWorld low = quiet(folder, box + "0.3\n"), high = quiet(folder, box + "0.5\n");
    EXPECT_NEAR(CLaserModel(low.laser, CWorld(low), 1).trueRanges({0, 0, 0})[180], 3.82, 1e-9);
    EXPECT_NEAR(CLaserModel(high.laser, CWorld(high), 1).trueRanges({0, 0, 0})[180], 1.32, 1e-9);
}

TEST(CLaserModel, MillimetreModeEndsAt8191AndCentimetreModeDoesNot) {
    const CTemporaryFolder folder;
    TWorld world = quiet(folder, "[wall_far]\nfrom_m = 20 3\nto_m = 20 -3\n");
    const CWorld geometry(world);
    const TPose2D outside(10, 0, 0);  // the far wall is 9.82 m from the laser
    const auto millimetres = CLaserModel(world.laser, geometry, 1).scan(outside, 0);
    EXPECT_FALSE(millimetres.getScanRangeValidity(180));
    EXPECT_FLOAT_EQ(millimetres.maxRange, 8.191f);
    world.laser.mode = ELaserMode::cm;
    const auto centimetres = CLaserModel(world.laser, geometry, 1).scan(outside, 0);
    EXPECT_TRUE(centimetres.getScanRangeValidity(180));
    EXPECT_FLOAT_EQ(centimetres.getScanRange(180), 9.82f);
    EXPECT_FALSE(centimetres.getScanRangeValidity(0));  // nothing there at all
    EXPECT_NEAR(centimetres.stdError, 0.01 / std::sqrt(12.0), 1e-6);
}

TEST(CLaserModel, OffersTheFieldsOfTheLms200) {
    const CTemporaryFolder folder;
    TWorld world = quiet(folder);
    world.laser.aperture = EAperture::deg100;
    world.laser.resolution = EResolution::one;
    const auto scan = CLaserModel(world.laser, CWorld(world), 1).scan({0, 0, 0}, 0);
    EXPECT_EQ(scan.getScanSize(), 101u);
    EXPECT_NEAR(scan.aperture, 100 * M_PI / 180, 1e-6);
    EXPECT_NEAR(scan.getScanRange(0), 1.5 / std::sin(50 * M_PI / 180), 0.0006);
}

TEST(CLaserModel, HasTheNoiseItStatesAndOneOffsetPerRun) {
    const CTemporaryFolder folder;
    const TWorld world = load(folder, roomIni());
    const CWorld geometry(world);
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const CLaserModel laser(world.laser, geometry, seed);
        EXPECT_LE(std::abs(laser.offset()), 0.015);
        double sum = 0, squares = 0;
        constexpr int n = 2000;
        for (int i = 0; i < n; ++i) {
            const double error = laser.scan({0, 0, 0}, std::uint64_t(i)).getScanRange(180) - 3.82;
            sum += error;
            squares += error * error;
        }
        const double mean = sum / n, sigma = std::sqrt(squares / n - mean * mean);
        EXPECT_NEAR(mean, laser.offset(), 4 * 0.005 / std::sqrt(n));
        EXPECT_NEAR(sigma, 0.005, 0.0004);
    }
    EXPECT_NE(CLaserModel(world.laser, geometry, 1).offset(),
              CLaserModel(world.laser, geometry, 2).offset());
}

TEST(CLaserModel, ABeamOnAnEdgeReturnsARangeBetweenItsTwoSides) {
    const CTemporaryFolder folder;
    // the near right edge of the box lies in the direction of beam 180 exactly
    TWorld world = quiet(folder, "[box_b]\ncentre_m = 2 0.5\nlength_m = 1\ndepth_m = 1\n");
    const CLaserModel laser(world.laser, CWorld(world), 1);
    int between = 0;
    for (int i = 0; i < 50; ++i) {
        const double range = laser.scan({0, 0, 0}, std::uint64_t(i)).getScanRange(180);
        EXPECT_GE(range, 1.319);
        EXPECT_LE(range, 3.821);
        if (range > 1.4 && range < 3.7) ++between;
    }
    EXPECT_GT(between, 30);
}

}  // namespace
}  // namespace salma::simulator
