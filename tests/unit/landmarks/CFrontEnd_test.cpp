// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/landmarks/CFrontEnd.h>

#include <cmath>
#include <limits>
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

TEST(CFrontEnd, AddsTheErrorOfTheBorderToTheCovarianceOfTheCentre) {
    TSeeingOptions options;
    options.border.sideSigma = 0;
    const TView v = view(0.5, 0.5, 5);
    const auto without = CFrontEnd(options).process(v).landmarks;
    options.border.sideSigma = 0.1;
    const auto with = CFrontEnd(options).process(v).landmarks;
    ASSERT_EQ(without.size(), 1u);
    ASSERT_EQ(with.size(), 1u);
    const Eigen::Matrix<double, 6, 6> added =
        with[0].pose.cov.asEigen() - without[0].pose.cov.asEigen();
    // Two sides of 0.1 m: variance 0.005 along the wall (sin a, -cos a) and upwards, else nothing.
    const Eigen::Vector2d along(std::sin(0.5), -std::cos(0.5));
    Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
    expected.topLeftCorner<2, 2>() = 0.005 * along * along.transpose();
    expected(2, 2) = 0.005;
    EXPECT_LT((added - expected).cwiseAbs().maxCoeff(), 1e-9);
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
    EXPECT_EQ(result.refused.at("picture without region"), 1u);
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

TEST(CFrontEnd, FindsThePaintingWithEachDetector) {
    for (const auto detector :
         {EDetector::scaleSaliency, EDetector::mser, EDetector::both, EDetector::quad}) {
        TSeeingOptions options;
        options.selection.detector = detector;
        const auto result = CFrontEnd(options).process(view(0.3, 0.3, 5));
        ASSERT_EQ(result.landmarks.size(), 1u) << int(detector);
        EXPECT_NEAR(result.landmarks[0].width, 0.5, 0.05) << int(detector);
        EXPECT_NEAR(result.landmarks[0].height, 0.4, 0.05) << int(detector);
        EXPECT_NEAR(result.landmarks[0].pose.mean.z(), 1.2, 0.03) << int(detector);
    }
}

TEST(CFrontEnd, FindsNothingWithAnyDetectorInAPictureOfOneColourAndSaysSo) {
    for (const auto detector :
         {EDetector::scaleSaliency, EDetector::mser, EDetector::both, EDetector::quad}) {
        TSeeingOptions options;
        options.selection.detector = detector;
        TView v = view(0, 0, 5);
        v.grey.setTo(120);
        const auto result = CFrontEnd(options).process(v);
        EXPECT_TRUE(result.landmarks.empty());
        EXPECT_EQ(result.refused.at("picture without region"), 1u);
    }
}

TEST(CFrontEnd, StoresNothingOfAWallThatIsSeenAtAGrazingAngle) {
    // The robot looks along a wall 0.3 m to its left; the painting hangs 2 m ahead, at 81 deg.
    TView v = view(0, 0, 5);
    v.walls = {test::wall(0.3, M_PI_2)};
    v.walls[0].from = {6, 0.3};
    v.walls[0].to = {-1, 0.3};
    v.T_r_c = test::cameraPose(0.2);
    const appearance::CWallView wall(v.camera, v.T_r_c, v.walls[0]);
    v.grey = test::pictureOf(wall, cv::Rect2d(1.6, 1.0, 0.8, 0.5), 5);
    const auto result = CFrontEnd().process(v);
    EXPECT_TRUE(result.landmarks.empty());
    EXPECT_FALSE(result.refused.empty());
}

TEST(CFrontEnd, RefusesAPictureWhosePoseIsNoNumber) {
    const double nan = std::nan("");
    for (const auto& pose :
         {mrpt::poses::CPose3D(nan, 0, 1.2, 0, 0, 0), mrpt::poses::CPose3D(0, 0, 1.2, nan, 0, 0),
          mrpt::poses::CPose3D(0, std::numeric_limits<double>::infinity(), 1.2, 0, 0, 0)}) {
        TView v = view(0, 0, 5);
        v.T_r_c = pose;
        const auto result = CFrontEnd().process(v);
        EXPECT_TRUE(result.landmarks.empty());
        EXPECT_EQ(result.refused.at("picture from an unknown pose"), 1u);
    }
}

TEST(CFrontEnd, RefusesWallsThatAreNoNumbersAndUsesTheOthers) {
    TView v = view(0, 0, 5);
    auto bad = v.walls[0];
    bad.rho = std::nan("");
    v.walls.push_back(bad);
    bad = v.walls[0];
    bad.to.x = std::numeric_limits<double>::infinity();
    v.walls.insert(v.walls.begin(), bad);
    const auto result = CFrontEnd().process(v);
    EXPECT_EQ(result.landmarks.size(), 1u);
    EXPECT_EQ(result.refused.at("wall that is no line"), 2u);
    v.walls = {test::wall(1.8, 0)};
    v.walls[0].covariance(0, 1) = std::nan("");
    const auto unsure = CFrontEnd().process(v);
    EXPECT_TRUE(unsure.landmarks.empty());
    EXPECT_EQ(unsure.refused.at("bad wall"), 1u);
}

/// Two paintings, one on each wall of a nook, 4 cm from its edge.
TView nook() {
    TView v = view(0, 0, 5);
    const double a = M_PI / 4;
    v.walls = {test::wall(1.5, a), test::wall(1.5, -a)};
    const mrpt::math::TPoint2D edge(1.5 / std::cos(a), 0);
    v.walls[0].from = edge;
    v.walls[1].to = edge;
    const appearance::CWallView left(v.camera, v.T_r_c, v.walls[0]);
    const appearance::CWallView right(v.camera, v.T_r_c, v.walls[1]);
    const double u = left.toWall({319.5, 239.5})->x, w = right.toWall({319.5, 239.5})->x;
    const cv::Mat one = test::pictureOf(left, cv::Rect2d(u - 0.44, 1.0, 0.4, 0.4), 5);
    const cv::Mat two = test::pictureOf(right, cv::Rect2d(w + 0.04, 1.0, 0.4, 0.4), 7);
    v.grey = one.clone();
    two.colRange(320, 640).copyTo(v.grey.colRange(320, 640));
    return v;
}

TEST(CFrontEnd, SplitsAnEntityOnTwoPlanesAndPutsEachPartOnItsOwn) {
    TSeeingOptions options;
    options.selection.maxEntities = 2;
    options.selection.maxTries = 4;
    options.selection.touch = 6;  // the regions of both paintings make one group
    const auto result = CFrontEnd(options).process(nook());
    EXPECT_EQ(result.split, 1u);
    for (const auto& patch : result.landmarks) {
        EXPECT_NEAR(patch.width, 0.4, 0.05);
        EXPECT_NEAR(patch.height, 0.4, 0.05);
        // yaw of a patch is its wall's alpha less 90 deg
        EXPECT_NEAR(std::abs(std::abs(patch.pose.mean.yaw() + M_PI_2) - M_PI / 4), 0, 1e-6);
    }
    EXPECT_FALSE(result.landmarks.empty());
}

TEST(CFrontEnd, TriesTheNextEntityIfTheFirstIsRefused) {
    // A large painting, and right of it a small one with more detail.
    TView v = view(0, 0, 5);
    const appearance::CWallView wall(v.camera, v.T_r_c, v.walls[0]);
    v.grey = test::pictureOf(wall, cv::Rect2d(-0.5, 0.9, 0.5, 0.5), 6);
    test::pictureOf(wall, cv::Rect2d(0.25, 1.1, 0.25, 0.22), 9)
        .colRange(400, 640)
        .copyTo(v.grey.colRange(400, 640));
    TSeeingOptions options;
    options.selection.maxEntities = options.selection.maxTries = 1;
    const auto first = CFrontEnd(options).process(v);
    ASSERT_EQ(first.landmarks.size(), 1u);
    const bool smallWins = first.landmarks[0].width < 0.3;
    // Now the one that wins is refused.
    (smallWins ? options.frontEnd.minSize : options.frontEnd.maxSize) = 0.35;
    const auto one = CFrontEnd(options).process(v);
    EXPECT_TRUE(one.landmarks.empty());
    EXPECT_EQ(one.refused.count(smallWins ? "too small" : "too large"), 1u);
    EXPECT_EQ(one.refused.count("outnumbered"), 1u);
    options.selection.maxTries = 5;
    const auto more = CFrontEnd(options).process(v);
    ASSERT_EQ(more.landmarks.size(), 1u);
    EXPECT_NEAR(more.landmarks[0].width, smallWins ? 0.5 : 0.25, 0.03);
    EXPECT_EQ(more.refused.count("outnumbered"), 0u);
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
