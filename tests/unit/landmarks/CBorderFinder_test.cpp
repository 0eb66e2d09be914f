// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/landmarks/CBorderFinder.h>

#include "TestScene.h"

namespace salma::landmarks {
namespace {

constexpr double kResolution = 150;  // px/m

struct TWall {
    cv::Mat grey{300, 400, CV_8U, cv::Scalar(200)};
    cv::Mat valid{300, 400, CV_8U, cv::Scalar(255)};

    TWall() { cv::RNG(7).fill(noise, cv::RNG::NORMAL, 0, 2); }
    void hang(const cv::Rect& where) {
        const cv::Mat art = test::painting(where.height, where.width, 3) * 0.6;
        art.copyTo(grey(where));
        cv::Mat noisy;
        cv::add(grey, noise, noisy, cv::noArray(), CV_8U);
        grey = noisy;
    }
    cv::Mat noise = cv::Mat(300, 400, CV_16S);
};

TEST(CBorderFinder, FindsAPosterFromASmallBoxInsideIt) {
    TWall wall;
    wall.hang({120, 80, 130, 100});
    const auto found = CBorderFinder().find(wall.grey, wall.valid, {160, 110, 40, 30}, kResolution);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, 120, 2);
    EXPECT_NEAR(found->y, 80, 2);
    EXPECT_NEAR(found->br().x, 250, 2);
    EXPECT_NEAR(found->br().y, 180, 2);
}

TEST(CBorderFinder, GivesTheSameBorderWhicheverPartOfThePosterWasSalient) {
    TWall wall;
    wall.hang({120, 80, 130, 100});
    const CBorderFinder finder;
    const auto a = finder.find(wall.grey, wall.valid, {125, 90, 30, 30}, kResolution);
    const auto b = finder.find(wall.grey, wall.valid, {200, 130, 52, 52}, kResolution);
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->x, b->x, 2);
    EXPECT_NEAR(a->br().y, b->br().y, 2);
}

TEST(CBorderFinder, FindsNothingOnABareWallAndInATinyPicture) {
    TWall wall;
    EXPECT_FALSE(CBorderFinder().find(wall.grey, wall.valid, {160, 110, 40, 30}, kResolution));
    const cv::Mat tiny(4, 4, CV_8U, cv::Scalar(0));
    EXPECT_FALSE(CBorderFinder().find(tiny, tiny, {1, 1, 2, 2}, kResolution));
}

TEST(CBorderFinder, FindsNothingWhereThePictureEndsInsideThePoster) {
    TWall wall;
    wall.hang({120, 80, 130, 100});
    wall.valid.colRange(200, 400).setTo(0);
    EXPECT_FALSE(CBorderFinder().find(wall.grey, wall.valid, {140, 110, 40, 30}, kResolution));
}

}  // namespace
}  // namespace salma::landmarks
