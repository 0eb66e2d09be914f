// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/landmarks/CEntityDetector.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "CTemporaryFolder.h"
#include "TestScene.h"

namespace salma::landmarks {
namespace {

TDetections detect(EDetector detector, const cv::Mat& grey) {
    TDetectionOptions options;
    options.selection.detector = detector;
    return CEntityDetector(options).detect(grey);
}

/// A painting of 192 x 154 px, upright in the picture.
cv::Mat picture() {
    const appearance::CWallView wall(test::camera(), test::cameraPose(), test::wall(2, 0));
    return test::pictureOf(wall, cv::Rect2d(-0.25, 1.0, 0.5, 0.4), 5);
}

TEST(CEntityDetector, GivesSalientRegionsAboveTheThresholdAndNoAreas) {
    const auto found = detect(EDetector::scaleSaliency, picture());
    ASSERT_GT(found.regions.size(), 3u);
    EXPECT_TRUE(found.areas.empty());
    for (const auto& r : found.regions) EXPECT_GE(r.Y, 1.9);
}

TEST(CEntityDetector, JoinsTheSameSalientRegionsByStableOnes) {
    const auto alone = detect(EDetector::scaleSaliency, picture());
    const auto joined = detect(EDetector::both, picture());
    ASSERT_EQ(joined.regions.size(), alone.regions.size());
    for (std::size_t i = 0; i < alone.regions.size(); ++i)
        EXPECT_EQ(joined.regions[i].x, alone.regions[i].x);
    EXPECT_FALSE(joined.areas.empty());
}

TEST(CEntityDetector, TakesStableRegionsOfAllowedRadiiAsRegions) {
    TDetectionOptions options;
    options.selection.detector = EDetector::mser;
    options.saliency.scaleMin = 5;
    options.saliency.scaleMax = 12;
    const auto found = CEntityDetector(options).detect(picture());
    ASSERT_FALSE(found.regions.empty());
    EXPECT_GT(found.areas.size(), found.regions.size()) << "small and large ones join only";
    for (const auto& r : found.regions) {
        EXPECT_GE(r.s, 5);
        EXPECT_LE(r.s, 12);
        EXPECT_EQ(r.Y, 0);
    }
}

TEST(CEntityDetector, GivesFivePointsInsideEachContourThatBelongTogether) {
    cv::Mat grey(480, 640, CV_8UC1, cv::Scalar(190));
    grey(cv::Rect(200, 150, 100, 80)).setTo(60);
    const auto found = detect(EDetector::quad, grey);
    ASSERT_EQ(found.regions.size(), 5u);
    ASSERT_EQ(found.areas.size(), 1u);
    for (const auto& r : found.regions) {
        EXPECT_TRUE(cv::Rect(200, 150, 100, 80).contains({int(r.x), int(r.y)}))
            << r.x << " " << r.y;
        EXPECT_EQ(
            std::count(found.areas[0].begin(), found.areas[0].end(), cv::Point(int(r.x), int(r.y))),
            1);
    }
}

TEST(CEntityDetector, BringsADarkPictureToTheWantedBrightnessFirst) {
    cv::Mat dark;
    picture().convertTo(dark, CV_8U, 0.3);
    TDetectionOptions options;
    options.selection.detector = EDetector::scaleSaliency;
    options.selection.yMin = 1;
    options.selection.brightness = 0;
    const auto asItIs = CEntityDetector(options).detect(dark).regions;
    const auto bright = CEntityDetector(options).detect(picture()).regions;
    options.selection.brightness = cv::mean(dark)[0] * 2;
    const auto brighter = CEntityDetector(options).detect(dark).regions;
    cv::Mat twice;
    dark.convertTo(twice, CV_8U, 2);
    options.selection.brightness = 0;
    EXPECT_EQ(brighter.size(), CEntityDetector(options).detect(twice).regions.size());
    EXPECT_GT(brighter.size(), asItIs.size());
    options.selection.brightness = 20;  // never darker
    EXPECT_EQ(CEntityDetector(options).detect(picture()).regions.size(), bright.size());
}

TEST(CEntityDetector, FindsNothingInAPictureOfOneColour) {
    for (const auto detector :
         {EDetector::scaleSaliency, EDetector::mser, EDetector::both, EDetector::quad}) {
        const auto found = detect(detector, cv::Mat(480, 640, CV_8UC1, cv::Scalar(77)));
        EXPECT_TRUE(found.regions.empty());
        EXPECT_THROW(detect(detector, cv::Mat(480, 640, CV_16UC1)), std::invalid_argument);
    }
}

TEST(CEntityDetector, TakesTheRegionsOfAnotherProgramAsDiscsOfTheirArea) {
    const salma::test::CTemporaryFolder folder;
    const auto regions = folder.write("regions", "1.0\n1\n40 30 0.01 0 0.04\n");
    TDetectionOptions options;
    options.selection.detector = EDetector::external;
    EXPECT_THROW(CEntityDetector{options}, std::invalid_argument) << "no command";
    const auto program =
        folder.write("detector.sh", "test -s \"$1\" && cp " + regions + " \"$2\"\n");
    options.external.command = "sh " + program + " {image} {regions}";
    const auto found = CEntityDetector(options).detect(picture());
    ASSERT_EQ(found.regions.size(), 1u);
    EXPECT_EQ(found.regions[0].x, 40);
    EXPECT_NEAR(found.regions[0].s, std::sqrt(10 * 5), 1e-9);
    EXPECT_TRUE(found.areas.empty());
    options.external.command = "false {image} {regions}";
    EXPECT_THROW(CEntityDetector(options).detect(picture()), std::runtime_error);
}

}  // namespace
}  // namespace salma::landmarks
