// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/appearance/CPictureMatcher.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>

namespace salma::appearance {
namespace {

cv::Mat blobs(std::uint32_t seed) {
    std::mt19937 random(seed);
    cv::Mat picture(300, 400, CV_8UC1, cv::Scalar(120));
    for (int i = 0; i < 250; ++i)
        cv::rectangle(
            picture,
            cv::Rect(static_cast<int>(random() % 380), static_cast<int>(random() % 280),
                     4 + static_cast<int>(random() % 25), 4 + static_cast<int>(random() % 25)),
            cv::Scalar(random() % 256), -1);
    cv::GaussianBlur(picture, picture, {}, 1);
    return picture;
}

TEST(CPictureMatcher, FindsTheHomographyBetweenTwoViews) {
    const cv::Mat a = blobs(1);
    const cv::Matx33d H(0.9, 0.1, 20, -0.15, 0.95, 40, 2e-4, 1e-4, 1);
    cv::Mat b;
    cv::warpPerspective(a, b, H, {420, 340});
    const auto match = CPictureMatcher().match(a, b);
    EXPECT_EQ(match.decision, EDecision::same);
    EXPECT_GT(match.score, 0.8);
    for (const cv::Point2d& p : {cv::Point2d(50, 60), {350, 80}, {200, 250}}) {
        const cv::Vec3d x = H * cv::Vec3d(p.x, p.y, 1);
        const cv::Vec3d y = match.homography * cv::Vec3d(p.x, p.y, 1);
        EXPECT_NEAR(y[0] / y[2], x[0] / x[2], 1);
        EXPECT_NEAR(y[1] / y[2], x[1] / x[2], 1);
    }
    const auto again = CPictureMatcher().match(a, b);
    EXPECT_EQ(again.score, match.score);
    EXPECT_EQ(again.homography, match.homography);
}

TEST(CPictureMatcher, TellsOtherPicturesAndMirroredOnesApart) {
    const cv::Mat a = blobs(1);
    EXPECT_EQ(CPictureMatcher().match(a, blobs(2)).decision, EDecision::other);
    cv::Mat mirrored;
    cv::flip(a, mirrored, 1);
    EXPECT_NE(CPictureMatcher().match(a, mirrored).decision, EDecision::same);
}

TEST(CPictureMatcher, DoesNotDecideWithoutKeypoints) {
    const cv::Mat empty;
    const cv::Mat plain(200, 200, CV_8UC1, cv::Scalar(90));
    for (const cv::Mat& nothing : {empty, plain}) {
        const auto match = CPictureMatcher().match(blobs(1), nothing);
        EXPECT_EQ(match.decision, EDecision::unknown);
        EXPECT_EQ(match.logLikelihoodRatio, 0);
    }
    EXPECT_THROW(CPictureMatcher().match(blobs(1), cv::Mat(100, 100, CV_8UC3)),
                 std::invalid_argument);
}

TEST(CPictureMatcher, RefusesDecisionsThatOverlap) {
    TPictureMatcherOptions options;
    options.decideOther = options.decideSame;
    EXPECT_THROW(CPictureMatcher{options}, std::invalid_argument);
}

TEST(CPictureMatcher, FollowsAMuralAroundToASlantingView) {
    SALMA_NEED_DATA(folder, "homography/churchill");
    const cv::Mat a = cv::imread(folder + "/1.png", cv::IMREAD_GRAYSCALE);
    for (const std::string k : {"2", "3"}) {
        const cv::Mat b = cv::imread(folder + "/" + k + ".png", cv::IMREAD_GRAYSCALE);
        const auto match = CPictureMatcher().match(a, b);
        EXPECT_EQ(match.decision, EDecision::same);
        cv::Matx33d truth;
        std::ifstream file(folder + "/H_1_" + k);
        for (double& value : truth.val) file >> value;
        ASSERT_TRUE(file);
        for (const cv::Point2d& p : {cv::Point2d(300, 500), {600, 700}}) {
            const cv::Vec3d x = truth * cv::Vec3d(p.x, p.y, 1);
            const cv::Vec3d y = match.homography * cv::Vec3d(p.x, p.y, 1);
            EXPECT_NEAR(y[0] / y[2], x[0] / x[2], 3) << k;
            EXPECT_NEAR(y[1] / y[2], x[1] / x[2], 3) << k;
        }
    }
}

TEST(CPictureMatcher, DoesNotTakeGraffitiOrABoatForTheMural) {
    SALMA_NEED_DATA(folder, "homography");
    const cv::Mat mural = cv::imread(folder + "/churchill/1.png", cv::IMREAD_GRAYSCALE);
    for (const char* name : {"/graf/img1.ppm", "/boat/img1.pgm"}) {
        const cv::Mat other = cv::imread(folder + name, cv::IMREAD_GRAYSCALE);
        ASSERT_FALSE(other.empty());
        EXPECT_EQ(CPictureMatcher().match(mural, other).decision, EDecision::other) << name;
    }
}

}  // namespace
}  // namespace salma::appearance
