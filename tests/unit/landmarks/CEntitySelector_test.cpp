// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/landmarks/CEntitySelector.h>

#include <cmath>
#include <limits>

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
    options.touch = 1;
    options.minRegions = 2;
    options.lowest = 0.6;
    return CEntitySelector(options).select({regions, stable}, walls);
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

TEST(CEntitySelector, RanksTheEntityWithMostRegionsFirstEvenIfAnotherIsMoreSalient) {
    const auto result = select({region(100, 240, 9), region(115, 240, 9), region(400, 240),
                                region(415, 240), region(430, 240)});
    ASSERT_EQ(result.entities.size(), 2u);
    EXPECT_EQ(result.entities[0].regions.size(), 3u);
    EXPECT_EQ(result.entities[1].regions.size(), 2u);
}

TEST(CEntitySelector, DecidesTiesBySaliencyThenByTheSizeOnTheWall) {
    const auto bySaliency = select(
        {region(300, 240, 3), region(315, 240, 3), region(100, 240, 9), region(115, 240, 9)});
    ASSERT_EQ(bySaliency.entities.size(), 2u);
    EXPECT_EQ(bySaliency.entities[0].regions[0].x, 100);
    const auto bySize = select(
        {region(300, 240, 0), region(310, 240, 0), region(100, 240, 0), region(119, 240, 0)});
    ASSERT_EQ(bySize.entities.size(), 2u);
    EXPECT_EQ(bySize.entities[0].regions[0].x, 100) << "as stable regions, without a saliency";
}

TEST(CEntitySelector, JoinsDistantRegionsInsideOneStableRegion) {
    const std::vector<TSalientRegion> apart{region(300, 240), region(360, 240)};
    EXPECT_TRUE(select(apart).entities.empty());
    std::vector<cv::Point> pixels;
    for (int x = 290; x < 370; ++x)
        for (int y = 235; y < 245; ++y) pixels.emplace_back(x, y);
    EXPECT_EQ(select(apart, {pixels}).entities.size(), 1u);
}

TEST(CEntitySelector, SplitsAGroupThatLiesOnTwoPlanesAndCountsIt) {
    // A near wall on the left half of the picture, a far one behind it on the right.
    auto near = test::wall(1.5, 0);
    near.from = {1.5, 0.01};  // it ends in the middle of the picture
    const std::vector<appearance::CWallView> walls{
        {test::camera(), test::cameraPose(), near},
        {test::camera(), test::cameraPose(), test::wall(3, 0)}};
    const std::vector<TSalientRegion> across{region(290, 240), region(305, 240), region(347, 240),
                                             region(362, 240)};
    TSelectionOptions options;
    options.touch = 3;
    options.wallMargin = 0;
    const auto split = CEntitySelector(options).select({across, {}}, walls);
    ASSERT_EQ(split.entities.size(), 2u);
    EXPECT_EQ(split.split, 1u);
    EXPECT_EQ(split.tooFewRegions, 0u);
    for (const auto& entity : split.entities)
        for (const auto& r : entity.regions) EXPECT_EQ(r.x > 319.5, entity.wall == 1) << r.x;
    const auto whole = CEntitySelector(options).select({across, {}}, oneWall());
    EXPECT_EQ(whole.entities.size(), 1u);
    EXPECT_EQ(whole.split, 0u);
}

TEST(CEntitySelector, SplitsOnlyTheGroupThatCrossesTheEdge) {
    auto near = test::wall(1.5, 0);
    near.from = {1.5, 0.01};
    const std::vector<appearance::CWallView> walls{
        {test::camera(), test::cameraPose(), near},
        {test::camera(), test::cameraPose(), test::wall(3, 0)}};
    TSelectionOptions options;
    options.wallMargin = 0;
    const std::vector<TSalientRegion> regions{region(310, 240), region(330, 240), region(100, 240),
                                              region(115, 240), region(500, 240), region(515, 240)};
    const auto result = CEntitySelector(options).select({regions, {}}, walls);
    EXPECT_EQ(result.split, 1u);
    EXPECT_EQ(result.tooFewRegions, 2u) << "one region is left on each side of the edge";
    EXPECT_EQ(result.entities.size(), 2u);
}

TEST(CEntitySelector, KeepsAGroupOnTwoPiecesOfOnePlane) {
    auto left = test::wall(2, 0), right = test::wall(2, 0);
    left.from = {2, 0.02};  // the laser saw one wall in two pieces, 4 cm apart
    right.to = {2, -0.02};
    const std::vector<appearance::CWallView> walls{{test::camera(), test::cameraPose(), left},
                                                   {test::camera(), test::cameraPose(), right}};
    const auto result = select({region(310, 240), region(329, 240)}, {}, walls);
    ASSERT_EQ(result.entities.size(), 1u);
    EXPECT_EQ(result.entities[0].regions.size(), 2u);
    EXPECT_EQ(result.split, 0u);
}

TEST(CEntitySelector, CountsWhatLiesOnNoWallOrOutOfHeight) {
    // 479.. 240 px below the middle at 385 px/m: 0.62 m lower than the camera, at v = 0.58
    const auto low = select({region(300, 479), region(305, 479)});
    EXPECT_TRUE(low.entities.empty());
    EXPECT_EQ(low.outOfHeight, 2u);
    EXPECT_EQ(low.onNoWall, 0u);
    EXPECT_EQ(select({region(300, 240), region(305, 240)}, {}, {}).onNoWall, 2u);
}

TEST(CEntitySelector, LetsAnEntityBeWhereTheLaserSeesNothingBehindIt) {
    // Two pieces of wall with a hole of 0.8 m in the middle of the picture, which the beams pass.
    auto left = test::wall(2, 0), right = test::wall(2, 0);
    left.from = {2, 0.4};
    right.to = {2, -0.4};
    const std::vector<appearance::CWallView> walls{{test::camera(), test::cameraPose(), left},
                                                   {test::camera(), test::cameraPose(), right}};
    const auto result = select({region(310, 240), region(329, 240), region(320, 250)}, {}, walls);
    EXPECT_TRUE(result.entities.empty());
    EXPECT_EQ(result.onNoWall, 3u);
}

TEST(CEntitySelector, RefusesRegionsWithoutPlaceOrSize) {
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    std::vector<TSalientRegion> bad(7, region(310, 240));
    bad[0].x = nan;
    bad[1].y = inf;
    bad[2].s = 0;
    bad[3].s = -4;
    bad[4].s = nan;
    bad[5].s = inf;
    bad[6].x = -inf;
    auto all = bad;
    all.push_back(region(310, 240));
    all.push_back(region(320, 240));
    const auto result = select(all);
    EXPECT_EQ(result.notFinite, 7u);
    ASSERT_EQ(result.entities.size(), 1u);
    EXPECT_EQ(result.entities[0].regions.size(), 2u);
}

TEST(CEntitySelector, GivesNothingWithoutRegions) {
    const auto result = select({});
    EXPECT_TRUE(result.entities.empty());
    EXPECT_EQ(result.onNoWall + result.outOfHeight + result.notFinite + result.tooFewRegions, 0u);
}

TEST(CEntitySelector, DoesNotDependOnTheOrderOfTheRegions) {
    const auto a = select({region(300, 240), region(319, 240), region(100, 240), region(119, 240)});
    const auto b = select({region(119, 240), region(319, 240), region(100, 240), region(300, 240)});
    ASSERT_EQ(a.entities.size(), 2u);
    ASSERT_EQ(b.entities.size(), 2u);
    EXPECT_EQ(a.entities[0].box.u0, b.entities[0].box.u0);
}

}  // namespace
}  // namespace salma::landmarks
