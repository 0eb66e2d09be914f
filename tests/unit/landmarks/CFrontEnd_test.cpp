// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/landmarks/CFrontEnd.h>

#include <stdexcept>

#include "TestScene.h"

namespace salma::landmarks {
namespace {

/// A painting of 0.5 x 0.4 m on a wall 1.8 m from the robot, seen at an angle.
TView view(double alpha, double pan, int seed, bool hung = true) {
    TView v;
    v.camera = test::camera();
    v.T_r_c = test::cameraPose(pan);
    v.walls = {test::wall(1.8, alpha)};
    const appearance::CWallView wall(v.camera, v.T_r_c, v.walls[0]);
    v.grey = test::pictureOf(wall, hung ? cv::Rect2d(-0.2, 1.0, 0.5, 0.4) : cv::Rect2d(), seed);
    return v;
}

TEST(CFrontEnd, FindsThePaintingWithItsPlaceAndSizeFromSeveralSides) {
    const CFrontEnd frontEnd;
    for (const double alpha : {0.0, 0.5, -0.6}) {
        const auto result = frontEnd.process(view(alpha, alpha, 5));
        ASSERT_EQ(result.landmarks.size(), 1u) << alpha;
        const auto& patch = result.landmarks[0];
        EXPECT_NEAR(patch.width, 0.5, 0.05) << alpha;
        EXPECT_NEAR(patch.height, 0.4, 0.05) << alpha;
        // its centre is at u = 0.05, v = 1.2; u runs along (sin alpha, -cos alpha)
        EXPECT_NEAR(patch.pose.mean.x(), 1.8 * cos(alpha) + 0.05 * sin(alpha), 0.04) << alpha;
        EXPECT_NEAR(patch.pose.mean.y(), 1.8 * sin(alpha) - 0.05 * cos(alpha), 0.04) << alpha;
        EXPECT_NEAR(patch.pose.mean.z(), 1.2, 0.03) << alpha;
        EXPECT_FALSE(patch.regions.empty()) << "the second look describes it";
        EXPECT_EQ(patch.texture.size(), appearance::CTexture::kBins) << "the wall around it";
        for (const auto& r : patch.regions) {
            EXPECT_LE(std::abs(r.x), patch.width / 2) << "metres from the centre";
            EXPECT_LE(std::abs(r.y), patch.height / 2);
            EXPECT_GT(r.s, 0.02);
            EXPECT_LT(r.s, 0.21);
        }
    }
}

TEST(CFrontEnd, FindsThePaintingFromKadirsClustersToo) {
    TSeeingOptions options;
    options.clustering.method = saliency::EClustering::kadir;
    const TView v = view(0.5, 0.5, 5);
    const auto found = CFrontEnd(options).process(v).landmarks;
    const auto greedy = CFrontEnd().process(v).landmarks;
    ASSERT_EQ(found.size(), 1u);
    ASSERT_EQ(greedy.size(), 1u);
    EXPECT_NEAR(found[0].width, 0.5, 0.05);
    EXPECT_NEAR(found[0].height, 0.4, 0.05);
    ASSERT_FALSE(found[0].regions.empty());
    EXPECT_NE(found[0].regions[0].x, greedy[0].regions[0].x) << "the option has no effect";
}

TEST(CFrontEnd, StoresNothingOfABareWallAndSaysSo) {
    const auto result = CFrontEnd().process(view(0, 0, 5, false));
    EXPECT_TRUE(result.landmarks.empty());
    EXPECT_EQ(result.refused.at("picture without salient region"), 1u);
}

TEST(CFrontEnd, StoresNothingWithoutAWall) {
    TView v = view(0, 0, 5);
    v.walls.clear();
    const auto result = CFrontEnd().process(v);
    EXPECT_TRUE(result.landmarks.empty());
    EXPECT_GT(result.refused.at("region on no wall"), 0u);
}

TEST(CFrontEnd, RefusesAPaintingThatThePictureCuts) {
    // turned so far that the painting leaves the picture on the left
    const auto result = CFrontEnd().process(view(0, -0.42, 5));
    EXPECT_TRUE(result.landmarks.empty());
}

TEST(CFrontEnd, RefusesAPaintingThatANearerWallHides) {
    TView v = view(0, 0, 5);
    // A wall 1 m away that ends on the ray to the middle of the painting, and all right of it.
    auto near = test::wall(1, 0);
    near.to = {1, -0.05 / 1.8};
    const appearance::CWallView nearView(v.camera, v.T_r_c, near);
    for (int y = 0; y < 480; ++y)
        for (int x = 0; x < 640; ++x)
            if (nearView.toWall({double(x), double(y)})->x > -near.to.y)
                v.grey.at<uchar>(y, x) = 190;
    EXPECT_EQ(CFrontEnd().process(v).landmarks.size(), 1u) << "half the painting looks like one";
    v.walls.push_back(near);
    const auto result = CFrontEnd().process(v);
    EXPECT_TRUE(result.landmarks.empty());
    EXPECT_EQ(result.refused.at("partly hidden by a nearer wall"), 1u);
}

TEST(CFrontEnd, RefusesPicturesOfAnotherTypeOrSize) {
    TView v = view(0, 0, 5);
    v.grey.convertTo(v.grey, CV_16U);
    EXPECT_THROW(CFrontEnd().process(v), std::invalid_argument);
}

TEST(CFrontEnd, GivesTheSameResultEachTime) {
    const TView v = view(0.3, 0.3, 9);
    const auto a = CFrontEnd().process(v), b = CFrontEnd().process(v);
    ASSERT_EQ(a.landmarks.size(), 1u);
    ASSERT_EQ(b.landmarks.size(), 1u);
    EXPECT_EQ(a.landmarks[0].pose.mean, b.landmarks[0].pose.mean);
    EXPECT_EQ(a.landmarks[0].keypoints.size(), b.landmarks[0].keypoints.size());
}

}  // namespace
}  // namespace salma::landmarks
