// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/CPatchDescriptor.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>

namespace salma::appearance {
namespace {

cv::Mat noise(int rows, int cols) {
    std::mt19937 random(5);
    cv::Mat picture(rows, cols, CV_8UC1);
    for (auto& g : cv::Mat_<std::uint8_t>(picture)) g = static_cast<std::uint8_t>(random() % 256);
    cv::GaussianBlur(picture, picture, {}, 3);
    cv::normalize(picture, picture, 0, 255, cv::NORM_MINMAX);
    return picture;
}

TEST(CPatchDescriptor, MeasuresPlaceAndSizeInMetresFromTheCentre) {
    cv::Mat blob(201, 301, CV_8UC1, cv::Scalar(20));  // at 100 px/m: 3.01 m x 2.01 m
    cv::circle(blob, {200, 60}, 8, cv::Scalar(240), -1);
    cv::GaussianBlur(blob, blob, {}, 2);
    const auto keypoints = CPatchDescriptor().describe(blob, 100);
    ASSERT_FALSE(keypoints.empty());
    EXPECT_NEAR(keypoints[0].x, 0.5, 0.01);  // 50 px right of column 150
    EXPECT_NEAR(keypoints[0].y, 0.4, 0.01);  // 40 px above row 100
    EXPECT_GT(keypoints[0].scale, 0.06);
    EXPECT_LT(keypoints[0].scale, 0.24);
}

TEST(CPatchDescriptor, TurnsAnglesCounterClockwiseWithThePicture) {
    const cv::Mat upright = noise(160, 160);
    cv::Mat turned;
    cv::rotate(upright, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
    const auto a = CPatchDescriptor().describe(upright, 100);
    const auto b = CPatchDescriptor().describe(turned, 100);
    int found = 0;
    for (const auto& p : a)
        for (const auto& q : b) {
            // (x, y) turns to (-y, x)
            if (std::hypot(q.x + p.y, q.y - p.x) > 0.01 || std::abs(q.scale / p.scale - 1) > 0.05)
                continue;
            const double turn = mrpt::math::wrapToPi(q.angle - p.angle - M_PI / 2);
            found += std::abs(turn) < 0.1;
        }
    EXPECT_GT(found, static_cast<int>(a.size()) / 2);
}

TEST(CPatchDescriptor, KeepsTheStrongestInTheSameOrderEachTime) {
    TDescriptorOptions few;
    few.maxKeypoints = 10;
    const auto all = CPatchDescriptor().describe(noise(200, 200), 50);
    const auto ten = CPatchDescriptor(few).describe(noise(200, 200), 50);
    ASSERT_GT(all.size(), 10U);
    ASSERT_EQ(ten.size(), 10U);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(ten[i].x, all[i].x);
        EXPECT_EQ(ten[i].descriptor, all[i].descriptor);
    }
}

TEST(CPatchDescriptor, LooksTwiceAtADimPatch) {
    cv::Mat dim;
    noise(200, 200).convertTo(dim, CV_8U, 0.3, 20);
    observations::TPatch patch;
    patch.width = patch.height = 2;
    patch.pixelsPerMetre = 100;
    patch.picture = mrpt::img::CImage(dim, mrpt::img::DEEP_COPY);
    EXPECT_LT(CPatchDescriptor().describe(dim, 100).size(), 12U);
    EXPECT_GT(CPatchDescriptor().describe(patch).size(), 20U);
    // one colour and the camera's noise
    cv::Mat plain(200, 200, CV_8U);
    cv::RNG random(1);
    random.fill(plain, cv::RNG::NORMAL, 80, 2);
    patch.picture = mrpt::img::CImage(plain, mrpt::img::DEEP_COPY);
    EXPECT_TRUE(CPatchDescriptor().describe(patch).empty());
}

TEST(CPatchDescriptor, FindsNothingWhereThereIsNothing) {
    EXPECT_TRUE(CPatchDescriptor().describe(observations::TPatch()).empty());
    EXPECT_TRUE(CPatchDescriptor().describe(cv::Mat(), 100).empty());
    EXPECT_TRUE(CPatchDescriptor().describe(cv::Mat(80, 80, CV_8UC1, cv::Scalar(99)), 100).empty());
    EXPECT_TRUE(CPatchDescriptor().describe(noise(3, 200), 100).empty());
    EXPECT_THROW(CPatchDescriptor().describe(cv::Mat(80, 80, CV_8UC3), 100), std::invalid_argument);
    EXPECT_THROW(CPatchDescriptor().describe(noise(80, 80), 0), std::invalid_argument);
}

}  // namespace
}  // namespace salma::appearance
