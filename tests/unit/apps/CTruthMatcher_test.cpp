// SPDX-License-Identifier: BSD-3-Clause
#include <CTruthMatcher.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace salma::apps {
namespace {

using association::ELandmarkKind;

TTruth truth() {
    TTruth t;
    t.landmarks = {{1, ELandmarkKind::salient, {5, 1}},
                   {2, ELandmarkKind::salient, {5, -1}},
                   {3, ELandmarkKind::corner, {3, 1}},
                   {4, ELandmarkKind::corner, {3, 1.4}}};
    const auto poster = ELandmarkKind::salient;
    t.sightings = {{10, 1, poster, 100, 200, 4, 0.5},
                   {10, 2, poster, 400, 200, 4, -0.5},
                   {10, 3, ELandmarkKind::corner, std::nan(""), std::nan(""), 9, 0},
                   {11, 1, poster, 100, 200, 4, 0.5}};
    t.path = viz::TTrajectory{{10, {0, 0, 0}}, {10.5, {1, 0, M_PI / 2}}};
    return t;
}

slam::TAssociationRow salient(double time, double u, double v) {
    slam::TAssociationRow row;
    row.time = time;
    row.kind = ELandmarkKind::salient;
    row.range = 9;  // far from all
    row.u = u;
    row.v = v;
    return row;
}

TEST(CTruthMatcher, TakesTheNearestSightingOfThePicture) {
    const TTruth t = truth();
    const CTruthMatcher matcher({}, t);
    EXPECT_EQ(matcher.match(salient(10, 130, 240)), 1);   // 50 px
    EXPECT_EQ(matcher.match(salient(10, 136, 249)), -1);  // 60.8 px
    EXPECT_EQ(matcher.match(salient(10, 410, 190)), 2);
    EXPECT_EQ(matcher.match(salient(11, 410, 190)), -1) << "not in this picture";
    EXPECT_EQ(matcher.match(salient(10.0009, 100, 200)), 1);
    EXPECT_EQ(matcher.match(salient(10.0011, 100, 200)), -1);
    EXPECT_EQ(matcher.match(salient(9, 100, 200)), -1);
}

TEST(CTruthMatcher, TakesRangeAndBearingWhereThePictureDoesNotTell) {
    const TTruth t = truth();
    const CTruthMatcher matcher({}, t);
    slam::TAssociationRow row = salient(10, std::nan(""), std::nan(""));
    row.range = 4.2;
    row.bearing = -0.52;
    EXPECT_EQ(matcher.match(row), 2);
    row.bearing = -0.56;  // 3.4 deg off
    EXPECT_EQ(matcher.match(row), -1);
    row.bearing = -0.5;
    row.range = 4.31;
    EXPECT_EQ(matcher.match(row), -1);
}

TEST(CTruthMatcher, PlacesACornerByTheTruePoseAtItsTime) {
    const TTruth t = truth();
    const CTruthMatcher matcher({}, t);
    slam::TAssociationRow row;
    row.kind = ELandmarkKind::corner;
    row.time = 10;
    row.range = std::hypot(3, 1.1);
    row.bearing = std::atan2(1.1, 3);
    EXPECT_EQ(matcher.match(row), 3);
    row.range = std::hypot(3, 1.25);
    row.bearing = std::atan2(1.25, 3);
    EXPECT_EQ(matcher.match(row), 4) << "the nearer of two within reach";
    row.time = 10.5;  // at (1, 0), facing north: (3, 1) is 2 m to the right, 1 m ahead
    row.range = std::sqrt(5);
    row.bearing = std::atan2(-2, 1);
    EXPECT_EQ(matcher.match(row), 3);
    row.range += 0.31;
    EXPECT_EQ(matcher.match(row), -1);
    row.time = 20;
    EXPECT_EQ(matcher.match(row), -1) << "the true pose is not known then";
    EXPECT_TRUE(matcher.knowsCorners());
    TTruth withoutPath = truth();
    withoutPath.path.reset();
    EXPECT_FALSE(CTruthMatcher({}, withoutPath).knowsCorners());
}

TEST(CTruthMatcher, RefusesLimitsThatAreNotPositive) {
    TTruthMatcherOptions options;
    options.maxPixels = std::nan("");
    const TTruth t = truth();
    EXPECT_THROW(CTruthMatcher(options, t), std::invalid_argument);
}

}  // namespace
}  // namespace salma::apps
