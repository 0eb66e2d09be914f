// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/CStableRegions.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace salma::saliency {
namespace {

/// A dark bar of 40x20 and a bright disc of radius 12 on mid grey.
cv::Mat barAndDisc() {
    cv::Mat picture(100, 140, CV_8UC1, cv::Scalar(128));
    picture(cv::Rect(20, 30, 40, 20)).setTo(10);
    cv::circle(picture, {100, 60}, 12, cv::Scalar(240), cv::FILLED);
    return picture;
}

TStableRegionsOptions lenient() {
    TStableRegionsOptions options;
    options.maxAreaFraction = 0.5;
    return options;
}

TEST(CStableRegions, TellsADarkBarFromABrightDisc) {
    const auto regions = CStableRegions(lenient()).detect(barAndDisc());
    ASSERT_EQ(regions.size(), 2u);
    const auto& bar = regions[0];
    EXPECT_EQ(bar.polarity, EPolarity::darkOnBright);
    EXPECT_EQ(bar.box, cv::Rect(20, 30, 40, 20));
    EXPECT_EQ(bar.pixels.size(), 800u);
    EXPECT_DOUBLE_EQ(bar.meanGrey, 10);
    EXPECT_EQ(regions[1].polarity, EPolarity::brightOnDark);
    EXPECT_DOUBLE_EQ(regions[1].meanGrey, 240);
    EXPECT_NEAR(regions[1].ellipse.radius(), 12, 0.7);
}

TEST(CStableRegions, GivesARectangleTheEllipseOfItsSecondMoments) {
    const auto regions = CStableRegions(lenient()).detect(barAndDisc());
    ASSERT_FALSE(regions.empty());
    // A rectangle of 40x20 has the moments 40^2/12 and 20^2/12; half axes are two deviations.
    const TEllipse& e = regions[0].ellipse;
    EXPECT_NEAR(e.u, 39.5, 1e-9);
    EXPECT_NEAR(e.v, 39.5, 1e-9);
    EXPECT_NEAR(1 / e.a, 4 * 1600 / 12.0, 1e-6);
    EXPECT_NEAR(e.b, 0, 1e-12);
    EXPECT_NEAR(1 / e.c, 4 * 400 / 12.0, 1e-6);
}

TEST(CStableRegions, SwapsThePolaritiesOfTheNegative) {
    cv::Mat negative;
    cv::bitwise_not(barAndDisc(), negative);
    const auto regions = CStableRegions(lenient()).detect(negative);
    ASSERT_EQ(regions.size(), 2u);
    EXPECT_EQ(regions[0].polarity, EPolarity::darkOnBright);
    EXPECT_NEAR(regions[0].ellipse.u, 100, 1e-9);
    EXPECT_EQ(regions[1].box, cv::Rect(20, 30, 40, 20));
}

TEST(CStableRegions, LeavesOutRegionsBeyondItsLimitsOfArea) {
    auto options = lenient();
    options.minArea = 500;
    EXPECT_EQ(CStableRegions(options).detect(barAndDisc()).size(), 1u);  // the disc has about 450
    options = lenient();
    options.maxAreaFraction = 600.0 / 14000;
    const auto regions = CStableRegions(options).detect(barAndDisc());
    ASSERT_EQ(regions.size(), 1u);
    EXPECT_EQ(regions[0].polarity, EPolarity::brightOnDark);
}

TEST(CStableRegions, DoesNotJoinPixelsThatShareACornerOnly) {
    cv::Mat picture(60, 60, CV_8UC1, cv::Scalar(200));
    picture(cv::Rect(10, 10, 15, 15)).setTo(20);
    picture(cv::Rect(25, 25, 15, 15)).setTo(20);
    for (const auto& region : CStableRegions(lenient()).detect(picture))
        EXPECT_LE(region.pixels.size(), 225u);
    EXPECT_EQ(CStableRegions(lenient()).detect(picture).size(), 2u);
}

TEST(CStableRegions, FindsNothingInEmptyTinyOrFlatPictures) {
    const CStableRegions detector;
    EXPECT_TRUE(detector.detect(cv::Mat()).empty());
    EXPECT_TRUE(detector.detect(cv::Mat(1, 1, CV_8UC1, cv::Scalar(0))).empty());
    EXPECT_TRUE(detector.detect(cv::Mat(2, 50, CV_8UC1, cv::Scalar(0))).empty());
    EXPECT_TRUE(detector.detect(cv::Mat(3, 3, CV_8UC1, cv::Scalar(0))).empty());
    EXPECT_TRUE(detector.detect(cv::Mat(50, 50, CV_8UC1, cv::Scalar(99))).empty());
}

TEST(CStableRegions, RefusesPicturesThatAreNotGreyOfEightBits) {
    for (const int type : {CV_8UC3, CV_16UC1, CV_32FC1})
        EXPECT_THROW(CStableRegions().detect(cv::Mat(20, 20, type, cv::Scalar::all(0))),
                     std::invalid_argument);
}

TEST(TEllipse, RefusesMomentsAndScalesThatMakeNone) {
    EXPECT_THROW(ellipseOfMoments(0, 0, {1, 1, 1}), std::invalid_argument);
    EXPECT_THROW(ellipseOfMoments(0, 0, {NAN, 0, 1}), std::invalid_argument);
    EXPECT_THROW(ellipseOf({5, 5, 0, 1, 1, 1}), std::invalid_argument);
    EXPECT_DOUBLE_EQ(ellipseOf({5, 6, 4, 1, 1, 1}).radius(), 4);
}

}  // namespace
}  // namespace salma::saliency
