// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/CQuadrilaterals.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace salma::saliency {
namespace {

using Corners = std::vector<cv::Point>;

/// Polygons of one grey level on a bright wall with some noise.
cv::Mat wallWith(const std::vector<Corners>& shapes, int level = 80) {
    cv::Mat picture(300, 400, CV_8UC1, cv::Scalar(190));
    for (const auto& shape : shapes)
        cv::fillConvexPoly(picture, shape, cv::Scalar(level), cv::LINE_AA);
    cv::Mat noise(picture.size(), CV_16S), noisy;
    cv::RNG(4).fill(noise, cv::RNG::NORMAL, 0, 2);
    cv::add(picture, noise, noisy, cv::noArray(), CV_8U);
    return noisy;
}

void expectCorners(const TQuad& quad, const Corners& clockwise, double tolerance) {
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(quad.corners[i].x, clockwise[i].x, tolerance) << i;
        EXPECT_NEAR(quad.corners[i].y, clockwise[i].y, tolerance) << i;
    }
}

TEST(CQuadrilaterals, FindsAPosterSeenAtAnAngleOnceWithItsCornersClockwise) {
    const Corners poster{{100, 60}, {220, 90}, {225, 210}, {95, 240}};
    const auto found = CQuadrilaterals().detect(wallWith({poster}));
    ASSERT_EQ(found.size(), 1u) << "both sides of the edge, and all levels, are one";
    expectCorners(found[0], poster, 5);
    EXPECT_NEAR(found[0].area, cv::contourArea(poster), 0.08 * cv::contourArea(poster));
}

TEST(CQuadrilaterals, FindsFaintPostersToo) {
    const Corners poster{{100, 60}, {220, 60}, {220, 160}, {100, 160}};
    EXPECT_EQ(CQuadrilaterals().detect(wallWith({poster}, 160)).size(), 1u);
    TQuadOptions strict;
    strict.contrast = 60;
    EXPECT_TRUE(CQuadrilaterals(strict).detect(wallWith({poster}, 160)).empty());
}

TEST(CQuadrilaterals, GivesTheLargestFirst) {
    const auto found =
        CQuadrilaterals().detect(wallWith({{{20, 20}, {60, 20}, {60, 60}, {20, 60}},
                                           {{150, 50}, {300, 50}, {300, 200}, {150, 200}}}));
    ASSERT_EQ(found.size(), 2u);
    EXPECT_GT(found[0].area, found[1].area);
}

TEST(CQuadrilaterals, TakesNoOtherShape) {
    const auto found = CQuadrilaterals().detect(
        wallWith({{{60, 60}, {120, 60}, {90, 120}},  // triangle
                  {{200, 60}, {240, 60}, {260, 95}, {240, 130}, {200, 130}, {180, 95}}}));  // six
    EXPECT_TRUE(found.empty());
    cv::Mat dented(300, 400, CV_8UC1, cv::Scalar(190));
    const std::vector<Corners> arrow{{{100, 60}, {220, 150}, {100, 240}, {160, 150}}};
    cv::fillPoly(dented, arrow, cv::Scalar(60));
    EXPECT_TRUE(CQuadrilaterals().detect(dented).empty());
}

TEST(CQuadrilaterals, RefusesWhatThePictureCutsAndWhatIsTooSmallOrTooLarge) {
    EXPECT_TRUE(CQuadrilaterals()
                    .detect(wallWith({{{-50, 60}, {120, 60}, {120, 160}, {-50, 160}}}))
                    .empty());
    EXPECT_TRUE(
        CQuadrilaterals().detect(wallWith({{{60, 60}, {67, 60}, {67, 67}, {60, 67}}})).empty());
    EXPECT_TRUE(
        CQuadrilaterals().detect(wallWith({{{10, 10}, {390, 10}, {390, 290}, {10, 290}}})).empty());
}

TEST(CQuadrilaterals, FindsNothingInPicturesOfOneColourAndTinyOnes) {
    const CQuadrilaterals quads;
    EXPECT_TRUE(quads.detect(cv::Mat(300, 400, CV_8UC1, cv::Scalar(128))).empty());
    EXPECT_TRUE(quads.detect(cv::Mat(4, 4, CV_8UC1, cv::Scalar(128))).empty());
    EXPECT_TRUE(quads.detect(cv::Mat(0, 0, CV_8UC1)).empty());
    EXPECT_THROW(quads.detect(cv::Mat(300, 400, CV_8UC3)), std::invalid_argument);
}

TEST(CQuadrilaterals, SurvivesPicturesOfNoise) {
    for (int seed = 0; seed < 5; ++seed) {
        cv::Mat noise(120, 160, CV_8UC1);
        cv::RNG(seed).fill(noise, cv::RNG::UNIFORM, 0, 256);
        for (const auto& quad : CQuadrilaterals().detect(noise)) EXPECT_GT(quad.area, 0);
    }
}

TEST(CQuadrilaterals, RefusesOptionsOutOfRange) {
    TQuadOptions options;
    options.maxAreaFraction = 0;
    EXPECT_THROW(CQuadrilaterals{options}, std::invalid_argument);
    options = {};
    options.contrast = -1;
    EXPECT_THROW(CQuadrilaterals{options}, std::invalid_argument);
}

}  // namespace
}  // namespace salma::saliency
