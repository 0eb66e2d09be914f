// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/CLandmarkTable.h>

#include <cmath>

namespace salma::slam {
namespace {

/// A poster on a wall that faces the robot at `wallAngle`, seen at `bearing` [rad].
association::TMeasurement poster(double bearing, double wallAngle) {
    association::TMeasurement measurement;
    measurement.kind = association::ELandmarkKind::salient;
    measurement.z << 3, bearing;
    measurement.wallAngle = wallAngle;
    measurement.wallAngleSigma = 0.03;
    auto patch = std::make_shared<observations::TPatch>();
    patch->width = bearing;  // a mark to know it by
    measurement.patch = patch;
    return measurement;
}

TEST(CLandmarkTable, TakesIdentitiesForIdsAndNumbersTheRest) {
    CLandmarkTable table(4, 0.2);
    association::TMeasurement measurement;
    EXPECT_EQ(table.add(measurement, 0), 0);
    measurement.identity = 5;
    EXPECT_EQ(table.add(measurement, 0), 5);
    measurement.identity.reset();
    EXPECT_EQ(table.add(measurement, 0), 6);
    measurement.identity = 6;  // in use
    EXPECT_EQ(table.add(measurement, 0), 7);
    EXPECT_EQ(table[3].identity, 6);
}

TEST(CLandmarkTable, KeepsTheWallInTheWorldAndPredictsItInTheRobotFrame) {
    CLandmarkTable table(4, 0.2);
    table.add(poster(0, M_PI), 0);
    table.sight(0, poster(0, M_PI), 0, {0.5, 0.04});
    EXPECT_NEAR(table[0].wallAngle, 0.5 - M_PI, 1e-12);
    EXPECT_NEAR(table[0].wallAngleSigma, 0.05, 1e-12);  // hypot(0.03, 0.04)
    const auto expected = table.expected(0, {1.5, 0.12});
    EXPECT_NEAR(expected.wallAngle, M_PI - 1, 1e-12);
    EXPECT_NEAR(expected.wallAngleSigma, 0.13, 1e-12);  // hypot(0.05, 0.12)
    // A worse look changes nothing, a better one does.
    table.sight(0, poster(0, 3), 1, {0, 0.05});
    EXPECT_NEAR(table[0].wallAngle, 0.5 - M_PI, 1e-12);
    table.sight(0, poster(0, 3), 2, {0, 0});
    EXPECT_NEAR(table[0].wallAngle, 3, 1e-12);
    EXPECT_NEAR(table[0].firstWallAngle, 0.5 - M_PI, 1e-12);
    EXPECT_EQ(table[0].sightings, 3u);
    EXPECT_EQ(table[0].lastTime, 2);
}

TEST(CLandmarkTable, KeepsViewsFromDifferentAnglesAndDropsTheMostOblique) {
    CLandmarkTable table(2, 0.2);
    table.add(poster(0, 0), 0);
    // The angle from the normal to the robot is bearing + pi - wall angle.
    const auto look = [&](double angle) { table.sight(0, poster(angle, M_PI), 0, {}); };
    look(0.8);
    look(0.9);  // too near to the first
    EXPECT_EQ(table[0].views.size(), 1u);
    look(-0.8);  // the other side is another view
    EXPECT_EQ(table[0].views.size(), 2u);
    look(0.1);
    ASSERT_EQ(table[0].views.size(), 2u);
    double most = 0;
    double least = 1;
    for (const TView& view : table[0].views) {
        most = std::max(most, std::abs(view.angle));
        least = std::min(least, std::abs(view.angle));
    }
    EXPECT_NEAR(most, 0.8, 1e-9);
    EXPECT_NEAR(least, 0.1, 1e-9);
}

TEST(CLandmarkTable, JudgesByTheBestView) {
    CLandmarkTable table(4, 0.2);
    table.add(poster(0, 0), 0);
    for (double angle : {0.0, 0.5, 1.0}) table.sight(0, poster(angle, M_PI), 0, {});
    const observations::TPatch seen;
    const PatchRatio byMark = [](const auto&, const auto& stored) { return stored.width; };
    EXPECT_EQ(table.bestRatio(0, seen, byMark), 1);
    const PatchRatio silentOnTheLast = [](const auto&, const auto& stored) {
        return stored.width == 1 ? std::nan("") : stored.width;
    };
    EXPECT_EQ(table.bestRatio(0, seen, silentOnTheLast), 0.5);
    EXPECT_TRUE(std::isnan(
        table.bestRatio(0, seen, [](const auto&, const auto&) { return std::nan(""); })));
}

}  // namespace
}  // namespace salma::slam
