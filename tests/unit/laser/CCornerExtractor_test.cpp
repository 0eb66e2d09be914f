// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/laser/CCornerExtractor.h>

#include <Eigen/Dense>
#include <algorithm>

#include "segmentWorld.h"

namespace salma::laser {
namespace {

using mrpt::math::TPoint2D;
using mrpt::poses::CPose2D;
using test::castScan;

const test::TScanner kSick{361, M_PI, 0.005, 0.01, 0.0005};

/// Only corners where two walls are seen.
TCornerOptions withoutEdges() {
    TCornerOptions options;
    options.lineEnds = false;
    return options;
}

std::vector<TCorner> cornersOf(const test::TWorld& world, const CPose2D& pose, std::mt19937& r) {
    return CCornerExtractor(withoutEdges())
        .extract(CLineExtractor().extract(castScan(world, pose, kSick, r)))
        .corners;
}

TPoint2D inWorld(const TCorner& corner, const CPose2D& pose) {
    TPoint2D p;
    pose.composePoint(corner.position.x, corner.position.y, p.x, p.y);
    return p;
}

TEST(CCornerExtractor, TellsANookFromAnEdge) {
    // a wall ahead, and a pillar that stands on it
    const test::TWorld world{
        {{3, -3}, {3, -0.5}}, {{3, -0.5}, {2, -0.5}}, {{2, -0.5}, {2, 2}}, {{2, 2}, {1, 2}}};
    std::mt19937 random(1);
    const auto corners = cornersOf(world, CPose2D(0, -1.5, 0), random);
    ASSERT_EQ(corners.size(), 3U);
    EXPECT_NEAR(corners[0].position.x, 3, 0.03);
    EXPECT_NEAR(corners[0].position.y, 1, 0.03);
    EXPECT_FALSE(corners[0].convex);
    EXPECT_NEAR(corners[1].position.x, 2, 0.03);
    EXPECT_NEAR(corners[1].position.y, 1, 0.03);
    EXPECT_TRUE(corners[1].convex);
    EXPECT_FALSE(corners[2].convex);
}

TEST(CCornerExtractor, FindsNoCornerWhereOneWallHidesAnother) {
    // a pillar's edge before a wall, and a slanting board whose line would meet the wall elsewhere
    const test::TWorld world{{{3, -3}, {3, 3}}, {{1, -0.3}, {1, 0.5}}, {{2.4, -1.2}, {2.8, -0.9}}};
    std::mt19937 random(1);
    for (double y = -1; y <= 1; y += 0.1)
        EXPECT_TRUE(cornersOf(world, CPose2D(0, y, 0), random).empty()) << y;
}

TEST(CCornerExtractor, NeedsTwoLinesAndAnAngle) {
    EXPECT_TRUE(CCornerExtractor().extract({}).corners.empty());
    const test::TWorld bent{{{2, -2}, {2, 0}}, {{2, 0}, {1.6, 2}}};  // 11 deg
    std::mt19937 random(1);
    EXPECT_TRUE(cornersOf(bent, CPose2D(), random).empty());
}

/// Corners of a polygon between two sides that both show at least `least` neighbouring beams.
std::size_t visibleCorners(const test::TWorld& world, const CPose2D& pose, int least) {
    std::vector<std::pair<std::size_t, int>> runs;  // side, beams on it
    for (std::size_t i = 0; i < kSick.beams; ++i) {
        const double bearing = -M_PI / 2 + static_cast<double>(i) * M_PI / 360;
        const auto side =
            test::castRay(world, CPose2D(pose.x(), pose.y(), pose.phi() + bearing)).segment;
        if (runs.empty() || runs.back().first != side) runs.emplace_back(side, 0);
        ++runs.back().second;
    }
    std::size_t visible = 0;
    for (std::size_t i = 1; i < runs.size(); ++i) {
        const bool neighbours = runs[i].first == (runs[i - 1].first + 1) % world.size();
        visible += neighbours && std::min(runs[i - 1].second, runs[i].second) >= least;
    }
    return visible;
}

/// What a walk through the corridor with doors gave.
struct TWalk {
    std::size_t seen{0}, wrong{0};
    std::size_t visible{0};  //!< Corners with six beams on either side.
    double nees{0};
    double farthestJamb{0};
};

TWalk walk(double sigmaFloor, bool lineEnds = false) {
    TCornerOptions options;
    options.lineEnds = lineEnds;
    options.sigmaFloor = sigmaFloor;
    const auto outline = test::corridorOutline();
    const auto world = test::polygon(outline);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1);
    TWalk out;
    for (int i = 0; i < 300; ++i) {
        const CPose2D pose(9 * unit(random), 0.5 * unit(random), M_PI * unit(random));
        const auto corners =
            CCornerExtractor(options)
                .extract(CLineExtractor().extract(castScan(world, pose, kSick, random)))
                .corners;
        out.visible += visibleCorners(world, pose, 6);
        for (const TCorner& corner : corners) {
            const TPoint2D p = inWorld(corner, pose);
            const TPoint2D truth = *std::min_element(outline.begin(), outline.end(),
                                                     [&](const TPoint2D& a, const TPoint2D& b) {
                                                         return (a - p).norm() < (b - p).norm();
                                                     });
            ++out.seen;
            const Eigen::Rotation2Dd R(pose.phi());
            const Eigen::Vector2d error =
                R.inverse() * Eigen::Vector2d(p.x - truth.x, p.y - truth.y);
            const double d2 = error.dot(corner.covariance.inverse() * error);
            out.nees += d2;
            out.wrong += error.norm() > 0.08 && d2 > 13.8;  // chi-square(2) at 0.999
            const bool jamb = std::abs(truth.x) < 9 && truth.y > 0.5;
            if (jamb) out.farthestJamb = std::max(out.farthestJamb, corner.position.norm());
        }
    }
    out.nees /= static_cast<double>(out.seen);
    return out;
}

TEST(CCornerExtractor, FindsRealCornersOnlyInACorridorWithDoors) {
    const TWalk result = walk(0.01);
    RecordProperty("corners", static_cast<int>(result.seen));
    // what is missed lies beyond 9 m, at a slant, or on jambs with hardly any points
    EXPECT_GT(static_cast<double>(result.seen), 0.8 * static_cast<double>(result.visible));
    EXPECT_LT(static_cast<double>(result.wrong), 0.01 * static_cast<double>(result.seen));
    EXPECT_GT(result.farthestJamb, 1.2);
}

TEST(CCornerExtractor, StatesACovarianceThatTheErrorsHave) {
    // without the floor the propagated covariance must itself be consistent: E[chi-square(2)] = 2
    const double bare = walk(0).nees;
    EXPECT_GT(bare, 1.2);
    EXPECT_LT(bare, 3.5);
    EXPECT_LT(walk(0.01).nees, 2) << "the floor makes it cautious";
}

TEST(CCornerExtractor, TakesTheEdgeBeforeADepthJumpOnlyIfAsked) {
    const test::TWorld world{{{5, -5}, {5, 5}}, {{2, -1}, {2, 0.7}}};
    TCornerOptions options;
    options.lineEnds = true;
    options.sigmaFloor = 0;
    std::mt19937 random(2);
    double nees = 0;
    for (int i = 0; i < 100; ++i) {
        const CPose2D pose(0, -1 + 0.02 * i, 0);
        const auto lines = CLineExtractor().extract(castScan(world, pose, kSick, random));
        EXPECT_TRUE(CCornerExtractor(withoutEdges()).extract(lines).corners.empty());
        const auto edges = CCornerExtractor(options).extract(lines).corners;
        ASSERT_EQ(edges.size(), 2U) << pose.y();
        for (const TCorner& edge : edges) {
            const TPoint2D p = inWorld(edge, pose);
            const Eigen::Vector2d error(p.x - 2, p.y < 0 ? p.y + 1 : p.y - 0.7);
            EXPECT_LT(error.norm(), 0.04);
            EXPECT_TRUE(edge.convex);
            nees += error.dot(edge.covariance.inverse() * error) / 200;
        }
    }
    EXPECT_GT(nees, 1.2);
    EXPECT_LT(nees, 3.5);
}

TEST(CCornerExtractor, FindsMoreDoorsByTheEdgesOfTheirWallsAndStillNoFalseCorners) {
    const TWalk without = walk(0.01);
    const TWalk with = walk(0.01, true);
    EXPECT_GT(with.seen, without.seen + without.seen / 2);
    EXPECT_LT(static_cast<double>(with.wrong), 0.01 * static_cast<double>(with.seen));
    EXPECT_LT(with.nees, 2.5);
}

TEST(CCornerExtractor, RefusesOptionsThatContradictEachOther) {
    TCornerOptions options;
    options.sigmaFloor = 0.1;
    EXPECT_THROW(CCornerExtractor{options}, std::invalid_argument);
}

}  // namespace
}  // namespace salma::laser
