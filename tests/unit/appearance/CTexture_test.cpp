// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/appearance/CTexture.h>

#include <cmath>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "wallRenderer.h"

namespace salma::appearance {
namespace {

/// Normal noise smeared over `grain` pixels around a mean grey, as wood and plaster look.
cv::Mat grained(const cv::Size& size, double mean, double sigma, const cv::Size& grain) {
    cv::Mat noise(size, CV_32F), grey;
    cv::RNG(9).fill(noise, cv::RNG::NORMAL, 0, 1);
    cv::blur(noise, noise, grain);
    cv::Scalar m, deviation;
    cv::meanStdDev(noise, m, deviation);
    noise = noise * (sigma / deviation[0]) + mean;
    noise.convertTo(grey, CV_8U);
    return grey;
}

cv::Mat wood(const cv::Size& size) { return grained(size, 120, 9, {3, 61}); }
cv::Mat plaster(const cv::Size& size) { return grained(size, 205, 1.5, {3, 3}); }

double distance(const cv::Mat& a, const cv::Mat& b) {
    const CTexture texture;
    return textureDistance(texture.describe(a), texture.describe(b)).value();
}

TEST(CTexture, IsAHistogram) {
    const auto histogram = CTexture().describe(wood({120, 120}));
    ASSERT_EQ(histogram.size(), CTexture::kBins);
    EXPECT_NEAR(std::accumulate(histogram.begin(), histogram.end(), 0.0), 1, 1e-4);
    for (const float bin : histogram) EXPECT_GE(bin, 0);
}

TEST(CTexture, KnowsThePatternsOfAPlainWallAndOfALonelyDot) {
    // On one grey all neighbours are as bright as the centre: all ones, least contrast.
    const auto plain = CTexture().describe(cv::Mat(60, 60, CV_8UC1, cv::Scalar(90)));
    EXPECT_NEAR(plain[8 * 5], 0.5, 1e-5);
    EXPECT_NEAR(plain[10 * 5 + 16 * 5], 0.5, 1e-5);
    // A dot of one pixel is brighter than all its neighbours: none of them is a one.
    cv::Mat dot(60, 60, CV_8UC1, cv::Scalar(90));
    dot.at<std::uint8_t>(30, 30) = 200;
    const auto dotted = CTexture().describe(dot);
    float none = 0;
    for (std::size_t c = 0; c < 5; ++c) none += dotted[c];
    EXPECT_NEAR(none, 0.5 / (54 * 54), 1e-6);
}

TEST(CTexture, TellsBrickFromWoodAndPlasterAndPaint) {
    SALMA_NEED_DATA(file, "posters/brick.png");
    cv::Mat brick = cv::imread(file, cv::IMREAD_GRAYSCALE);
    cv::resize(brick, brick, {}, 0.5, 0.5, cv::INTER_AREA);
    const cv::Mat upper = brick.rowRange(0, brick.rows / 2),
                  lower = brick.rowRange(brick.rows / 2, brick.rows);
    const double own = distance(upper, lower);
    const cv::Size size = upper.size();
    const cv::Mat paint(size, CV_8UC1, cv::Scalar(150));
    for (const cv::Mat& other : {wood(size), plaster(size), paint})
        EXPECT_GT(distance(upper, other), 3 * own);
    EXPECT_GT(distance(wood(size), plaster(size)), 3 * own);
    EXPECT_GT(distance(wood(size), paint), 3 * own);
}

TEST(CTexture, TellsTheWallsOfPhotographsApart) {
    // Patches of stone, of a red brick house, of weatherboard and of brick: halves belong together.
    SALMA_NEED_DATA(brickFile, "posters/brick.png");
    SALMA_NEED_DATA(stoneFile, "posters/kodak01.png");
    cv::Mat brick = cv::imread(brickFile, cv::IMREAD_GRAYSCALE);
    cv::resize(brick, brick, {}, 0.5, 0.5, cv::INTER_AREA);
    const cv::Mat house = cv::imread(stoneFile, cv::IMREAD_GRAYSCALE);
    const cv::Mat left = house(cv::Rect(20, 40, 120, 120)),
                  right = house(cv::Rect(180, 60, 120, 120));
    EXPECT_LT(distance(left, right), distance(left, brick));
    EXPECT_LT(distance(left, right), distance(right, brick));
}

TEST(CTexture, IsTheSameWhenTheWallIsTurnedByRightAngles) {
    const cv::Mat upright = wood({140, 100});
    for (const int turn :
         {cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180, cv::ROTATE_90_COUNTERCLOCKWISE}) {
        cv::Mat turned;
        cv::rotate(upright, turned, turn);
        EXPECT_LT(distance(upright, turned), 1e-2) << turn;
    }
}

TEST(CTexture, IsNearlyTheSameAtTwoStopsMoreOrLess) {
    cv::Mat normal = grained({140, 140}, 60, 8, {3, 31});
    normal.convertTo(normal, CV_32F);
    for (const double gain : {0.25, 0.5, 2.0, 4.0}) {
        EXPECT_LT(distance(normal, normal * gain), 0.02) << gain;
        cv::Mat eightBits;  // as a camera delivers it
        cv::Mat(normal * gain).convertTo(eightBits, CV_8U);
        EXPECT_LT(distance(normal, eightBits), 0.5 * distance(normal, plaster(normal.size())));
    }
}

/// Texture around a rectangle in the middle of a wall of `tile`, 6 m x 6 m.
std::vector<float> around(const cv::Mat& tile, double range, double alpha) {
    const double u = range * std::sin(alpha);
    const CWallView view(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, 0, 0),
                         test::wallLine(range * std::cos(alpha), alpha));
    std::mt19937 random(2);
    const cv::Mat picture =
        test::renderPoster(view, tile, {u - 3, -2.5, u + 3, 3.5}, {0.5, 1.5, 1}, random);
    return CTexture().describe(picture, view, {u - 0.2, 0.3, u + 0.2, 0.7});
}

TEST(CTexture, IsNearlyTheSameFromNearAndFarAndFromTheSide) {
    cv::Mat bricks(720, 720, CV_8UC1, cv::Scalar(160));  // 120 px/m, courses of 7.5 cm
    for (int row = 0; row < 80; ++row)
        for (int i = -1; i < 30; ++i)
            cv::rectangle(bricks, {i * 27 + (row % 2) * 13, row * 9, 24, 7},
                          cv::Scalar(70 + (i * 37 + row * 53) % 30), cv::FILLED);
    const cv::Mat boards = grained({720, 720}, 120, 12, {3, 91});
    const auto near = around(bricks, 2, 0);
    ASSERT_FALSE(near.empty());
    for (const auto& [range, alpha] : {std::pair{3.0, 0.0}, {4.0, 0.0}, {3.0, 0.6}, {2.5, -0.9}}) {
        const auto again = around(bricks, range, alpha), other = around(boards, range, alpha);
        ASSERT_FALSE(again.empty()) << range;
        EXPECT_LT(*textureDistance(near, again), 0.7 * *textureDistance(near, other))
            << range << " m, " << alpha;
    }
}

TEST(CTexture, DoesNotLookAtTheEntity) {
    const CWallView view(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, 0, 0),
                         test::wallLine(2, 0));
    const TWallRectangle place{-0.3, 0.2, 0.3, 0.8};
    std::mt19937 random(2);
    const cv::Mat bare(10, 10, CV_8UC1, cv::Scalar(150));  // the wall's own grey
    const auto without =
        CTexture().describe(test::renderPoster(view, bare, place, {}, random), view, place);
    const auto with = CTexture().describe(
        test::renderPoster(view, wood({300, 300}), place, {}, random), view, place);
    ASSERT_FALSE(without.empty());
    EXPECT_LT(*textureDistance(without, with), 1e-3);
}

TEST(CTexture, SaysNothingOfTooLittleWall) {
    const CTexture texture;
    EXPECT_TRUE(texture.describe(cv::Mat()).empty());
    EXPECT_TRUE(texture.describe(wood({12, 12})).empty());
    EXPECT_TRUE(texture.describe(wood({6, 300})).empty());
    const cv::Mat wall = wood({80, 80}), nothing = cv::Mat::zeros(80, 80, CV_8UC1);
    EXPECT_TRUE(texture.describe(wall, nothing).empty());
    EXPECT_THROW(texture.describe(wall, cv::Mat::zeros(8, 8, CV_8UC1)), std::invalid_argument);
    EXPECT_THROW(texture.describe(cv::Mat(80, 80, CV_8UC3)), std::invalid_argument);
    const CWallView view(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, 0, 0),
                         test::wallLine(2, 0));
    const cv::Mat picture(480, 640, CV_8UC1, cv::Scalar(9));
    EXPECT_TRUE(texture.describe(picture, view, {std::nan(""), 0, 1, 1}).empty());
    EXPECT_TRUE(texture.describe(picture, view, {0, 0, 0, 0}).empty());
    EXPECT_TRUE(texture.describe({}, view, {0, 0, 1, 1}).empty());
    EXPECT_FALSE(textureDistance({}, {}));
    EXPECT_FALSE(textureDistance({1}, {0.5, 0.5}));
    EXPECT_EQ(textureDistance({0.5, 0.5}, {0.5, 0.5}), 0);
    EXPECT_EQ(textureDistance({1, 0}, {0, 1}), 1);
}

}  // namespace
}  // namespace salma::appearance
