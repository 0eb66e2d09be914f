// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/landmarks/CBorderFinder.h>

#include <vector>

#include "TestScene.h"

namespace salma::landmarks {
namespace {

const cv::Point2d kResolution{150, 150};  // px/m
using Regions = std::vector<cv::Point2d>;

struct TWall {
    cv::Mat grey{300, 400, CV_8U, cv::Scalar(200)};
    cv::Mat valid{300, 400, CV_8U, cv::Scalar(255)};

    /// Bricks of 24 x 7 cm with bright mortar, each of its own grey.
    void build() {
        cv::RNG random(5);
        grey.setTo(150);
        for (int y = 0; y < 300; y += 12)
            for (int x = y / 12 % 2 * 18 - 36; x < 400; x += 36)
                cv::rectangle(grey, cv::Rect(x, y, 34, 10), cv::Scalar(random.uniform(85, 115)),
                              cv::FILLED);
    }

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

TEST(CBorderFinder, FindsAPosterFromAFewRegionsInsideIt) {
    TWall wall;
    wall.hang({120, 80, 130, 100});
    const auto found =
        CBorderFinder().find(wall.grey, wall.valid, {{160, 110}, {200, 140}}, kResolution);
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
    const auto a = finder.find(wall.grey, wall.valid, {{130, 95}, {150, 115}}, kResolution);
    const auto b = finder.find(wall.grey, wall.valid, {{210, 140}, {240, 170}}, kResolution);
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->x, b->x, 1);
    EXPECT_NEAR(a->y, b->y, 1);
    EXPECT_NEAR(a->br().x, b->br().x, 1);
    EXPECT_NEAR(a->br().y, b->br().y, 1);
}

TEST(CBorderFinder, TakesTheFrameAndNotThePaintingInIt) {
    TWall wall;
    wall.grey(cv::Rect(100, 60, 170, 140)).setTo(60);
    wall.grey(cv::Rect(106, 66, 158, 128)).setTo(230);  // a bright mat
    wall.hang({130, 85, 110, 90});
    const auto found =
        CBorderFinder().find(wall.grey, wall.valid, {{160, 110}, {200, 140}}, kResolution);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, 100, 2);
    EXPECT_NEAR(found->br().y, 200, 2);
}

TEST(CBorderFinder, IsNotDrawnToADoorThatIsTallerThanThePoster) {
    TWall wall;
    wall.grey(cv::Rect(290, 20, 100, 280)).setTo(90);
    wall.hang({120, 80, 130, 100});
    const auto found =
        CBorderFinder().find(wall.grey, wall.valid, {{160, 110}, {200, 140}}, kResolution);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->br().x, 250, 2);
}

TEST(CBorderFinder, TakesNoBricksForAPoster) {
    TWall wall;
    wall.build();
    EXPECT_FALSE(
        CBorderFinder().find(wall.grey, wall.valid, {{160, 110}, {200, 140}}, kResolution));
}

TEST(CBorderFinder, FindsAPosterOnBricksThatAreAsBrightAsItself) {
    TWall wall;
    wall.build();
    wall.hang({120, 75, 126, 97});
    const auto found =
        CBorderFinder().find(wall.grey, wall.valid, {{160, 110}, {200, 140}}, kResolution);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, 120, 2);
    EXPECT_NEAR(found->y, 75, 2);
    EXPECT_NEAR(found->br().x, 246, 2);
    EXPECT_NEAR(found->br().y, 172, 2);
}

TEST(CBorderFinder, DoesNotStretchAPosterOverTheGrainOfWood) {
    TWall wall;
    cv::RNG random(8);
    cv::Mat grain(1, 400, CV_8U);
    random.fill(grain, cv::RNG::NORMAL, 120, 16);
    cv::GaussianBlur(grain, grain, {15, 1}, 2.5);
    cv::repeat(grain, 300, 1, wall.grey);
    wall.hang({120, 80, 130, 100});
    const auto found =
        CBorderFinder().find(wall.grey, wall.valid, {{160, 110}, {200, 140}}, kResolution);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, 120, 2);
    EXPECT_NEAR(found->br().x, 250, 2);
}

TEST(CBorderFinder, TakesNoRectangleOfLinesWhoseInsideLooksLikeTheWall) {
    TWall wall;
    cv::rectangle(wall.grey, cv::Rect(120, 80, 130, 100), cv::Scalar(120), 1);
    EXPECT_FALSE(
        CBorderFinder().find(wall.grey, wall.valid, {{160, 110}, {200, 140}}, kResolution));
}

TEST(CBorderFinder, FindsTheBorderInADarkPictureToo) {
    TWall wall;
    wall.hang({120, 80, 130, 100});
    wall.grey.convertTo(wall.grey, CV_8U, 0.4);
    const auto found =
        CBorderFinder().find(wall.grey, wall.valid, {{160, 110}, {200, 140}}, kResolution);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, 120, 2);
    EXPECT_NEAR(found->br().y, 180, 2);
}

TEST(CBorderFinder, FindsNothingOnABareWallAndInATinyPicture) {
    TWall wall;
    const Regions regions{{160, 110}, {200, 140}};
    EXPECT_FALSE(CBorderFinder().find(wall.grey, wall.valid, regions, kResolution));
    const cv::Mat tiny(4, 4, CV_8U, cv::Scalar(0));
    EXPECT_FALSE(CBorderFinder().find(tiny, tiny, {{1, 1}}, kResolution));
    EXPECT_FALSE(CBorderFinder().find(wall.grey, wall.valid, {}, kResolution));
}

TEST(CBorderFinder, FindsNothingWhereThePictureEndsInsideThePoster) {
    TWall wall;
    wall.hang({120, 80, 130, 100});
    wall.valid.colRange(200, 400).setTo(0);
    EXPECT_FALSE(
        CBorderFinder().find(wall.grey, wall.valid, {{140, 110}, {180, 140}}, kResolution));
}

}  // namespace
}  // namespace salma::landmarks
