// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/landmarks/CEntitySelector.h>

#include "TestScene.h"

namespace salma::landmarks {
namespace {

using observations::TSalientRegion;

TSalientRegion region(double x, double y, double Y = 3) { return {x, y, 10, 2, 1, Y}; }

std::vector<appearance::CWallView> oneWall() {
    return {{test::camera(), test::cameraPose(), test::wall(2, 0)}};
}

TSelection select(const std::vector<TSalientRegion>& regions,
                  const std::vector<std::vector<cv::Point>>& stable = {},
                  const std::vector<appearance::CWallView>& walls = oneWall()) {
    TSelectionOptions options;
    options.yMin = 2;
    options.touch = 1;
    options.minRegions = 2;
    options.lowest = 0.6;
    return CEntitySelector(options).select(regions, stable, walls);
}

TEST(CEntitySelector, JoinsRegionsWhoseDiscsTouchAndDropsLonelyOnes) {
    const auto result = select({region(300, 240), region(319, 240), region(400, 240)});
    ASSERT_EQ(result.entities.size(), 1u);
    EXPECT_EQ(result.entities[0].regions.size(), 2u);
    EXPECT_EQ(result.tooFewRegions, 1u);
}

TEST(CEntitySelector, GivesTheBoxInWallMetres) {
    // 770 px focal length at 2 m: 385 px/m; the middle pixel looks at u = 0, v = 1.2.
    const auto result = select({region(309.5, 239.5), region(329.5, 239.5)});
    ASSERT_EQ(result.entities.size(), 1u);
    const auto& box = result.entities[0].box;
    EXPECT_NEAR(box.u0, -20 / 385.0, 1e-6);
    EXPECT_NEAR(box.u1, 20 / 385.0, 1e-6);
    EXPECT_NEAR(box.v0, 1.2 - 10 / 385.0, 1e-6);
    EXPECT_NEAR(box.v1, 1.2 + 10 / 385.0, 1e-6);
}

TEST(CEntitySelector, TakesTheEntityWithMostRegionsEvenIfAnotherIsMoreSalient) {
    const auto result = select({region(100, 240, 9), region(115, 240, 9), region(400, 240),
                                region(415, 240), region(430, 240)});
    ASSERT_EQ(result.entities.size(), 1u);
    EXPECT_EQ(result.entities[0].regions.size(), 3u);
    EXPECT_EQ(result.outnumbered, 1u);
}

TEST(CEntitySelector, JoinsDistantRegionsInsideOneStableRegion) {
    const std::vector<TSalientRegion> apart{region(300, 240), region(360, 240)};
    EXPECT_TRUE(select(apart).entities.empty());
    std::vector<cv::Point> pixels;
    for (int x = 290; x < 370; ++x)
        for (int y = 235; y < 245; ++y) pixels.emplace_back(x, y);
    EXPECT_EQ(select(apart, {pixels}).entities.size(), 1u);
}

TEST(CEntitySelector, NeverJoinsRegionsOfTwoWalls) {
    // A near wall on the left half of the picture, a far one behind it on the right.
    auto near = test::wall(1.5, 0);
    near.from = {1.5, 0.01};  // it ends in the middle of the picture
    const std::vector<appearance::CWallView> walls{
        {test::camera(), test::cameraPose(), near},
        {test::camera(), test::cameraPose(), test::wall(3, 0)}};
    const std::vector<TSalientRegion> across{region(290, 240), region(305, 240), region(347, 240),
                                             region(362, 240)};
    TSelectionOptions options;
    options.yMin = 2;
    options.touch = 3;
    options.maxEntities = 9;
    options.wallMargin = 0;
    EXPECT_EQ(CEntitySelector(options).select(across, {}, walls).entities.size(), 2u);
    EXPECT_EQ(CEntitySelector(options).select(across, {}, oneWall()).entities.size(), 1u);
}

TEST(CEntitySelector, CountsWhatIsTooWeakOrOnNoWall) {
    const auto result = select({region(300, 240, 1.9), region(300, 479, 3), region(305, 479, 3)});
    EXPECT_TRUE(result.entities.empty());
    EXPECT_EQ(result.belowThreshold, 1u);
    EXPECT_EQ(select({region(300, 240), region(305, 240)}, {}, {}).onNoWall, 2u);
}

TEST(CEntitySelector, DoesNotDependOnTheOrderOfTheRegions) {
    const auto a = select({region(300, 240), region(319, 240), region(100, 240), region(119, 240)});
    const auto b = select({region(119, 240), region(319, 240), region(100, 240), region(300, 240)});
    ASSERT_EQ(a.entities.size(), 1u);
    ASSERT_EQ(b.entities.size(), 1u);
    EXPECT_EQ(a.entities[0].box.u0, b.entities[0].box.u0);
}

}  // namespace
}  // namespace salma::landmarks
