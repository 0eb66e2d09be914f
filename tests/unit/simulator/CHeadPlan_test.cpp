// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/simulator/CHeadPlan.h>

#include <cmath>

#include "room.h"

namespace salma::simulator {
namespace {

using test::CTemporaryFolder;

double degrees(double angle) { return angle * 180 / M_PI; }

TEST(CHeadPlan, SweepsThereAndBackAndTakesPicturesAtRest) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, roomIni());
    world.path.points = {-1.5, 0, 3.5, 0};
    world.head.stops = {-60, 0, 60};
    const CPath path(world.path);
    const CHeadPlan plan(world.head, path, CWorld(world), 1);
    const double expected[] = {-60, 0, 60, 0, -60, 0};
    ASSERT_GE(plan.pictureTimes().size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        const double t = plan.pictureTimes()[i];
        for (const double shift : {-0.1, 0.0, 0.1})
            EXPECT_NEAR(degrees(plan.pan(t + shift)), expected[i], 1e-9);
    }
    for (double t = 0; t < path.duration(); t += 0.01)
        EXPECT_LE(std::abs(degrees(plan.pan(t + 0.01) - plan.pan(t))) / 0.01, 80 + 1e-6);
}

TEST(CHeadPlan, StaysWhereItIsFixed) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, roomIni("[head]\nmode = fixed:-35.5\nperiod_s = 0.5\n"));
    const CPath path(world.path);
    const CHeadPlan plan(world.head, path, CWorld(world), 1);
    EXPECT_NEAR(degrees(plan.pan(1.234)), -35.5, 1e-9);
    EXPECT_NEAR(static_cast<double>(plan.pictureTimes().size()), path.duration() / 0.5, 1.01);
}

TEST(CHeadPlan, AttendsToThePosterThatIsNearest) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, markerIni() + "[head]\nmode = attend\n");
    const CPath path(world.path);
    const CHeadPlan plan(world.head, path, CWorld(world), 1);
    ASSERT_GE(plan.pictureTimes().size(), 2u);
    const double t = plan.pictureTimes()[1];
    const auto robot = path.pose(t);
    const double x = 4 - (robot.x + world.head.x * std::cos(robot.phi));
    const double y = 0.3 - (robot.y + world.head.x * std::sin(robot.phi));
    EXPECT_NEAR(degrees(plan.pan(t)), degrees(std::atan2(y, x) - robot.phi), 1.0);
}

TEST(CHeadPlan, SweepsWhereNoPosterCanBeSeen) {
    const CTemporaryFolder folder;
    const TWorld world = load(folder, roomIni("[head]\nmode = attend\nstops_deg = -40 40\n"));
    const CPath path(world.path);
    const CHeadPlan plan(world.head, path, CWorld(world), 1);
    ASSERT_GE(plan.pictureTimes().size(), 2u);
    EXPECT_NEAR(degrees(plan.pan(plan.pictureTimes()[0])), -40, 1e-9);
    EXPECT_NEAR(degrees(plan.pan(plan.pictureTimes()[1])), 40, 1e-9);
}

}  // namespace
}  // namespace salma::simulator
