// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/appearance/CRegionDescriptor.h>

#include <cmath>
#include <stdexcept>

#include "wallRenderer.h"

namespace salma::appearance {
namespace {

using observations::TSalientRegion;

const TWallRectangle kPlace{-0.3, 0.2, 0.3, 0.8};

/// Discs of 6 cm radius on an even ground: one at (0.12, 0.15), one at (-0.1, -0.12) of its centre.
cv::Mat discs() {
    cv::Mat poster(600, 600, CV_8UC1, cv::Scalar(190));
    cv::circle(poster, {420, 150}, 60, cv::Scalar(30), -1, cv::LINE_AA);
    cv::circle(poster, {200, 420}, 60, cv::Scalar(80), -1, cv::LINE_AA);
    return poster;
}

std::vector<TSalientRegion> regionsFrom(double alpha, const test::TExposure& exposure = {}) {
    // the wall's normal turned by alpha, the poster in the middle of the picture
    const double u = 2 * std::sin(alpha);
    const CWallView view(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, 0, 0),
                         test::wallLine(2 * std::cos(alpha), alpha));
    const TWallRectangle place{u + kPlace.u0, kPlace.v0, u + kPlace.u1, kPlace.v1};
    std::mt19937 random(4);
    const cv::Mat picture = test::renderPoster(view, discs(), place, exposure, random);
    return CRegionDescriptor().describe(picture, view, place);
}

/// Distance from (x, y) to the nearest region [m].
double nearest(const std::vector<TSalientRegion>& regions, double x, double y) {
    double least = 10;
    for (const auto& r : regions) least = std::min(least, std::hypot(r.x - x, r.y - y));
    return least;
}

TEST(CRegionDescriptor, FindsDiscsInMetresOnThePatchFromEverySide) {
    for (const double alpha : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        const auto regions = regionsFrom(alpha);
        ASSERT_FALSE(regions.empty()) << alpha;
        EXPECT_LT(nearest(regions, 0.12, 0.15), 0.035) << alpha;
        EXPECT_LT(nearest(regions, -0.1, -0.12), 0.035) << alpha;
        for (const auto& r : regions) {
            EXPECT_LE(std::abs(r.x), 0.3);
            EXPECT_LE(std::abs(r.y), 0.3);
            EXPECT_GT(r.s, 3 / 120.0);
            EXPECT_LT(r.s, 24 / 120.0);
        }
    }
}

TEST(CRegionDescriptor, FindsTheStrongestAgainAtTwoStopsLess) {
    const auto bright = regionsFrom(0.4), dark = regionsFrom(0.4, {0, 0, 0.25});
    ASSERT_GE(bright.size(), 10U);
    ASSERT_GE(dark.size(), 10U);
    for (int i = 0; i < 10; ++i)
        EXPECT_LT(nearest(dark, bright[i].x, bright[i].y), bright[i].s) << i;
}

TEST(CRegionDescriptor, FindsNothingWhereThereIsNothing) {
    const CWallView view(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, 0, 0),
                         test::wallLine(2, 0));
    const CRegionDescriptor descriptor;
    const cv::Mat plain(480, 640, CV_8UC1, cv::Scalar(120));
    EXPECT_TRUE(descriptor.describe(plain, view, kPlace).empty()) << "one grey";
    EXPECT_TRUE(descriptor.describe({}, view, kPlace).empty());
    EXPECT_TRUE(descriptor.describe(plain, view, {0, 0, 0, 0}).empty());
    EXPECT_TRUE(descriptor.describe(plain, view, {0, 0, std::nan(""), 1}).empty());
    EXPECT_TRUE(descriptor.describe(plain, view, {0, 0, 1e9, 1}).empty());
    const CWallView away(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, M_PI, 0),
                         test::wallLine(2, 0));
    EXPECT_TRUE(descriptor.describe(plain, away, kPlace).empty()) << "behind the camera";
}

TEST(CRegionDescriptor, RefusesScalesOutOfOrder) {
    TSecondLookOptions options;
    options.scaleMin = 24;
    EXPECT_THROW(CRegionDescriptor{options}, std::invalid_argument);
}

}  // namespace
}  // namespace salma::appearance
