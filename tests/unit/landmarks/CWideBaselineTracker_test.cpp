// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/landmarks/CWideBaselineTracker.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace salma::landmarks {
namespace {

using observations::TPatch;

constexpr double kDegree = M_PI / 180;

/// A poster at (x, 2) on a wall y = 2 that faces the robot, seen from (robotX, 0).
TSighting poster(double robotX, double x = 0) {
    TSighting s;
    s.position = {x, 2};
    s.robot = {robotX, 0};
    s.wallAngle = -M_PI_2;
    s.patch = std::make_shared<TPatch>();
    return s;
}

TTrackingOptions options(int views = 2, double spreadDegrees = 10) {
    TTrackingOptions o;
    o.minViews = views;
    o.minSpread = spreadDegrees * kDegree;
    return o;
}

bool seen(CWideBaselineTracker& tracker, const TSighting& sighting) {
    tracker.beginStep();
    return tracker.confirms(sighting);
}

TEST(CWideBaselineTracker, ConfirmsOnceTheViewsSpanTheAngleAndForgetsThen) {
    CWideBaselineTracker tracker(options());
    EXPECT_FALSE(seen(tracker, poster(0)));
    EXPECT_FALSE(seen(tracker, poster(0.34))) << "9.6 deg";
    EXPECT_TRUE(seen(tracker, poster(0.36))) << "10.2 deg";
    EXPECT_EQ(tracker.size(), 0u);
}

TEST(CWideBaselineTracker, CountsPlacesAndNotSightings) {
    CWideBaselineTracker tracker(options(3, 10));
    for (int i = 0; i < 9; ++i) EXPECT_FALSE(seen(tracker, poster(0.01 * i)));
    EXPECT_FALSE(seen(tracker, poster(0.6))) << "the second place";
    EXPECT_TRUE(seen(tracker, poster(1.2))) << "the third one";
}

TEST(CWideBaselineTracker, AddsUpStepsThatAreShorterThanPlacesAreApart) {
    CWideBaselineTracker tracker(options());  // places 0.1 m apart, 10 deg
    int steps = 1;
    while (!seen(tracker, poster(0.06 * steps)) && steps < 100) ++steps;
    EXPECT_EQ(steps, 7) << "0.36 m from the first view: 10.1 deg";
}

TEST(CWideBaselineTracker, IsNotConfirmedByTurningOnTheSpot) {
    CWideBaselineTracker tracker(options(2, 5));
    EXPECT_FALSE(seen(tracker, poster(0)));
    for (int i = 0; i < 5; ++i) {
        auto again = poster(0);
        again.wallAngle += 0.12 * (i % 2);  // the wall's angle is known by half a degree, not by 7
        EXPECT_FALSE(seen(tracker, again));
    }
}

TEST(CWideBaselineTracker, KeepsNeighboursOnAWallApart) {
    CWideBaselineTracker tracker(options());
    EXPECT_FALSE(seen(tracker, poster(0, 0)));
    EXPECT_FALSE(seen(tracker, poster(1, 0.7)));
    EXPECT_EQ(tracker.size(), 2u);
    EXPECT_TRUE(seen(tracker, poster(2, 0.7))) << "the second poster, seen from elsewhere";
    EXPECT_EQ(tracker.size(), 1u);
}

TEST(CWideBaselineTracker, KeepsWallsOfOtherDirectionOrDistanceApart) {
    CWideBaselineTracker tracker(options());
    EXPECT_FALSE(seen(tracker, poster(0)));
    auto turned = poster(1);
    turned.wallAngle += 30 * kDegree;
    EXPECT_FALSE(seen(tracker, turned));
    auto behind = poster(1.2);
    behind.position.y() += 0.4;
    EXPECT_FALSE(seen(tracker, behind));
    auto alongOnly = poster(1.4);
    alongOnly.position.x() += 0.4;
    EXPECT_TRUE(seen(tracker, alongOnly)) << "along the wall odometry errs more";
}

TEST(CWideBaselineTracker, AsksAppearanceOfTheViewFromTheNearestDirection) {
    const auto left = poster(-1.5), middle = poster(0);
    const TPatch* asked = nullptr;
    const auto tracker = [&](double ratio) {
        return CWideBaselineTracker(options(3, 10),
                                    [&, ratio](const TPatch&, const TPatch& stored) {
                                        asked = &stored;
                                        return ratio;
                                    });
    };
    auto same = tracker(0);
    EXPECT_FALSE(seen(same, left));
    EXPECT_FALSE(seen(same, middle));
    EXPECT_TRUE(seen(same, poster(0.5)));
    EXPECT_EQ(asked, middle.patch.get());
    for (const double no : {-0.1, std::nan("")}) {
        auto other = tracker(no);
        EXPECT_FALSE(seen(other, left));
        EXPECT_FALSE(seen(other, middle));
        EXPECT_FALSE(seen(other, poster(0.5)));
        EXPECT_EQ(other.size(), 3u);
    }
}

TEST(CWideBaselineTracker, TakesOneSightingOfAnEntityPerStep) {
    CWideBaselineTracker tracker(options());
    tracker.beginStep();
    EXPECT_FALSE(tracker.confirms(poster(0)));
    EXPECT_FALSE(tracker.confirms(poster(1, 0.1)));
    EXPECT_EQ(tracker.size(), 2u);
}

TEST(CWideBaselineTracker, ForgetsWhatIsNotSeenAgain) {
    auto o = options();
    o.memory = 2;
    CWideBaselineTracker tracker(o);
    EXPECT_FALSE(seen(tracker, poster(0)));
    for (int i = 0; i < 3; ++i) tracker.beginStep();
    EXPECT_EQ(tracker.size(), 0u);
    EXPECT_FALSE(seen(tracker, poster(1)));
}

TEST(CWideBaselineTracker, TakesEverySightingWhereOneViewIsEnough) {
    CWideBaselineTracker tracker(options(1, 0));
    EXPECT_TRUE(seen(tracker, poster(0)));
    EXPECT_EQ(tracker.size(), 0u);
}

TEST(CWideBaselineTracker, KeepsNothingThatIsNoNumber) {
    CWideBaselineTracker tracker(options(1, 0));
    for (int i = 0; i < 4; ++i) {
        auto bad = poster(0);
        (i < 2 ? bad.position : bad.robot)[i % 2] =
            i == 0 ? std::nan("") : std::numeric_limits<double>::infinity();
        EXPECT_FALSE(seen(tracker, bad));
    }
    EXPECT_EQ(tracker.size(), 0u);
}

TEST(CWideBaselineTracker, RefusesOptionsOutOfRange) {
    EXPECT_THROW(CWideBaselineTracker(options(0)), std::invalid_argument);
    EXPECT_THROW(CWideBaselineTracker(options(2, -1)), std::invalid_argument);
    auto o = options();
    o.along = std::nan("");
    EXPECT_THROW(CWideBaselineTracker{o}, std::invalid_argument);
}

/// Corners of the laser: neither wall nor appearance.
TSighting corner(double x, bool convex = true) {
    TSighting s;
    s.position = {x, 0};
    s.convex = convex;
    return s;
}

CWideBaselineTracker cornerTracker(int sightings, int memory = 5) {
    TTrackingOptions o;
    o.minViews = sightings;
    o.minSpread = o.minTravel = 0;
    o.across = 0.3;
    o.memory = memory;
    return CWideBaselineTracker(o);
}

TEST(CWideBaselineTracker, ConfirmsACornerAtItsThirdSighting) {
    auto tracker = cornerTracker(3);
    for (int i = 0; i < 2; ++i) EXPECT_FALSE(seen(tracker, corner(1 + 0.1 * i)));
    EXPECT_TRUE(seen(tracker, corner(1.2)));
    EXPECT_EQ(tracker.size(), 0u);
}

TEST(CWideBaselineTracker, KeepsPlacesAndConvexityOfCornersApart) {
    auto tracker = cornerTracker(2);
    EXPECT_FALSE(seen(tracker, corner(1)));
    tracker.beginStep();
    EXPECT_FALSE(tracker.confirms(corner(1.31)));
    EXPECT_FALSE(tracker.confirms(corner(1, false)));
    EXPECT_TRUE(tracker.confirms(corner(1.01)));
}

}  // namespace
}  // namespace salma::landmarks
