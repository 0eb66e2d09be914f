// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/simulator/CWorld.h>

#include <algorithm>
#include <cmath>

#include "room.h"

namespace salma::simulator {
namespace {

using test::CTemporaryFolder;

bool hasCorner(const CWorld& world, double x, double y) {
    const auto there = [&](const TTrueLandmark& l) {
        return l.kind == ETruthKind::corner &&
               std::hypot(l.centre.x() - x, l.centre.y() - y) < 1e-6;
    };
    return std::any_of(world.landmarks().begin(), world.landmarks().end(), there);
}

std::size_t corners(const CWorld& world) {
    return static_cast<std::size_t>(
        std::count_if(world.landmarks().begin(), world.landmarks().end(),
                      [](const auto& l) { return l.kind == ETruthKind::corner; }));
}

TEST(CWorld, ARoomHasItsFourCorners) {
    const CTemporaryFolder folder;
    const CWorld world(load(folder, roomIni()));
    EXPECT_EQ(corners(world), 4u);
    EXPECT_TRUE(hasCorner(world, 4, -1.5));
}

// The north wall runs along y = 1.5 with its left end at x = -2, so a door 0.9 m wide at 2 m opens
// from x = -0.45 to 0.45, and its leaf stands back to y = 1.62.
TEST(CWorld, ADoorHasACornerAtEachJambAndBehindIt) {
    const CTemporaryFolder folder;
    const CWorld world(load(folder, roomIni("[door_d]\nwall = north\nat_m = 2\n")));
    EXPECT_EQ(corners(world), 8u);
    for (const double x : {-0.45, 0.45})
        for (const double y : {1.5, 1.62}) EXPECT_TRUE(hasCorner(world, x, y)) << x << " " << y;
}

TEST(CWorld, ABoxAgainstAWallHasCornersWhereItTouchesIt) {
    const CTemporaryFolder folder;
    const CWorld world(
        load(folder, roomIni("[box_b]\ncentre_m = 1 1.4\nlength_m = 1\ndepth_m = 0.2\n")));
    EXPECT_EQ(corners(world), 8u);
    EXPECT_TRUE(hasCorner(world, 0.5, 1.3));
    EXPECT_TRUE(hasCorner(world, 0.5, 1.5));
}

TEST(CWorld, OnlyWhatReachesTheBeamIsInItsPlane) {
    const CTemporaryFolder folder;
    const CWorld world(load(folder, roomIni("[box_b]\ncentre_m = 1 1\ntop_m = 0.3\n")));
    EXPECT_EQ(world.segmentsAt(0.4).size(), 4u);
    EXPECT_EQ(world.segmentsAt(0.2).size(), 8u);
}

TEST(CWorld, APosterHangsWhereItsWallSays) {
    const CTemporaryFolder folder;
    const CWorld world(load(folder, markerIni()));
    const TTrueLandmark& poster = world.landmarks().at(0);
    EXPECT_EQ(poster.kind, ETruthKind::salient);
    EXPECT_EQ(poster.id, 1);
    EXPECT_NEAR((poster.centre - Eigen::Vector3d(4, 0.3, 1.5)).norm(), 0, 1e-9);
    EXPECT_NEAR(std::abs(poster.yaw), M_PI, 1e-9);  // faces the room, towards -x
}

TEST(CWorld, SightIsBlockedByABoxAndNotByTheWallLookedAt) {
    const CTemporaryFolder folder;
    const CWorld world(load(folder, roomIni("[box_b]\ncentre_m = 1 0\ntop_m = 0.6\n")));
    const Eigen::Vector3d origin(0, 0, 0.5), wall(4, 0, 0.5);
    EXPECT_FALSE(world.visible(origin, wall));
    EXPECT_TRUE(world.visible(origin, {4, 0, 2.5}));
    EXPECT_TRUE(world.visible(origin, {4, 1.2, 0.5}));
    EXPECT_FALSE(world.visible(origin, {5, 1.2, 0.5}));
}

}  // namespace
}  // namespace salma::simulator
