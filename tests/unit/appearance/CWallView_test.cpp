// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/appearance/CWallView.h>

#include <opencv2/calib3d.hpp>
#include <stdexcept>

#include "wallRenderer.h"

namespace salma::appearance {
namespace {

using mrpt::math::TPoint2D;

mrpt::img::TCamera pinhole() {
    mrpt::img::TCamera camera;
    camera.ncols = 640;
    camera.nrows = 480;
    camera.setIntrinsicParamsFromValues(500, 500, 320, 240);
    return camera;
}

/// Camera 0.5 m above the robot's origin that looks ahead at a wall 2 m away.
CWallView frontal() {
    return {pinhole(), test::panTiltPose({0, 0, 0.5}, 0, 0), test::wallLine(2, 0)};
}

CWallView slanting() {
    return {test::pannedCamera(), test::panTiltPose({0.1, -0.05, 0.6}, 0.5, 0.1),
            test::wallLine(1.5, 1.2)};
}

TEST(CWallView, ShowsTheWallAheadUprightAndUnmirrored) {
    const CWallView view = frontal();
    const auto centre = view.toPixel(0, 0.5);
    ASSERT_TRUE(centre);
    EXPECT_NEAR(centre->x, 320, 1e-9);
    EXPECT_NEAR(centre->y, 240, 1e-9);
    const auto right = view.toPixel(0.2, 0.5);  // 0.2 m at 2 m with f = 500
    EXPECT_NEAR(right->x, 370, 1e-9);
    const auto above = view.toPixel(0, 0.7);
    EXPECT_NEAR(above->y, 190, 1e-9);
    EXPECT_NEAR(view.pixelsPerMetre(0, 0.5), 250, 1e-3);
    EXPECT_NEAR(view.incidence(0, 0.5), 0, 1e-6);
    EXPECT_NEAR(view.incidence(2, 0.5), M_PI / 4, 1e-9);
}

TEST(CWallView, PutsURightOfTheRobotAsItFacesTheWall) {
    const Eigen::Vector3d right = frontal().point(1, 0.3);
    EXPECT_NEAR(right.x(), 2, 1e-12);
    EXPECT_NEAR(right.y(), -1, 1e-12);  // y is left
    EXPECT_NEAR(right.z(), 0.3, 1e-12);
}

TEST(CWallView, FindsTheWayBackFromThePictureToTheWall) {
    const CWallView view = slanting();
    int seen = 0;
    for (double x = 0; x < 640; x += 80)
        for (double y = 0; y < 480; y += 60) {
            const auto uv = view.toWall({x, y});
            if (!uv) continue;
            const auto pixel = view.toPixel(uv->x, uv->y);
            ASSERT_TRUE(pixel);
            EXPECT_NEAR(pixel->x, x, 1e-6);
            EXPECT_NEAR(pixel->y, y, 1e-6);
            ++seen;
        }
    EXPECT_EQ(seen, 64);
}

TEST(CWallView, AgreesWithTheLensModelOfOpenCv) {
    mrpt::img::TCamera camera = test::pannedCamera();
    camera.dist = {-0.2, 0.05, 0.001, -0.002, 0.01, 0, 0, 0};
    const auto pose = test::panTiltPose({0.1, 0, 0.5}, 0.3, -0.1);
    const CWallView view(camera, pose, test::wallLine(2, 0.4));
    const cv::Matx33d K(705, 0, 319.5, 0, 705, 239.5, 0, 0, 1);
    for (double u = -0.6; u <= 0.6; u += 0.3) {
        const Eigen::Vector3d X = view.point(u, 0.4);
        mrpt::math::TPoint3D local;
        pose.inverseComposePoint(X.x(), X.y(), X.z(), local.x, local.y, local.z);
        std::vector<cv::Point2d> expected;
        cv::projectPoints(std::vector<cv::Point3d>{{local.x, local.y, local.z}}, cv::Vec3d(),
                          cv::Vec3d(), K, std::vector<double>{-0.2, 0.05, 0.001, -0.002, 0.01},
                          expected);
        const auto pixel = view.toPixel(u, 0.4);
        ASSERT_TRUE(pixel);
        EXPECT_NEAR(pixel->x, expected[0].x, 1e-9);
        EXPECT_NEAR(pixel->y, expected[0].y, 1e-9);
    }
}

TEST(CWallView, HasAHomographyThatMapsWallMetresToPixels) {
    const CWallView view(pinhole(), test::panTiltPose({0.2, 0.1, 0.4}, -0.4, 0.2),
                         test::wallLine(2, -0.3));
    const Eigen::Vector3d h = view.homography() * Eigen::Vector3d(0.3, 0.6, 1);
    const auto pixel = view.toPixel(0.3, 0.6);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(h.x() / h.z(), pixel->x, 1e-9);
    EXPECT_NEAR(h.y() / h.z(), pixel->y, 1e-9);
}

TEST(CWallView, SeesNothingBehindTheCameraOrTheWall) {
    const auto backwards = test::panTiltPose({0, 0, 0.5}, M_PI, 0);
    const CWallView away(pinhole(), backwards, test::wallLine(2, 0));
    EXPECT_FALSE(away.toPixel(0, 0.5));
    EXPECT_FALSE(away.toWall({320, 240}));
    const CWallView beyond(pinhole(), test::panTiltPose({3, 0, 0.5}, M_PI, 0),
                           test::wallLine(2, 0));
    EXPECT_FALSE(beyond.toPixel(0, 0.5)) << "the back of the wall";
    EXPECT_FALSE(beyond.toWall({320, 240}));
}

TEST(CWallView, DoesNotFoldFarPointsBackIntoThePicture) {
    mrpt::img::TCamera camera = test::pannedCamera();
    camera.dist[0] = -0.4;
    camera.dist[1] = 0;
    const CWallView view(camera, test::panTiltPose({0, 0, 0.5}, 0, 0), test::wallLine(1, 0));
    double last = -1;
    for (double u = 0; u < 20; u += 0.05) {
        const auto pixel = view.toPixel(u, 0.5);
        if (!pixel) break;
        EXPECT_GT(pixel->x, last);
        last = pixel->x;
    }
    EXPECT_FALSE(view.toPixel(5, 0.5));
}

TEST(CWallView, KnowsWhereTheWallEnds) {
    laser::TLine line = test::wallLine(2, 0);
    line.from = {2, -1};  // to the right
    line.to = {2, 3};
    const CWallView view(pinhole(), test::panTiltPose({0, 0, 0}, 0, 0), line);
    EXPECT_NEAR(view.extent().first, -3, 1e-12);
    EXPECT_NEAR(view.extent().second, 1, 1e-12);
}

TEST(CWallView, RefusesCamerasThatItDoesNotModel) {
    const auto pose = test::panTiltPose({0, 0, 0}, 0, 0);
    EXPECT_THROW(CWallView(mrpt::img::TCamera(), pose, test::wallLine(2, 0)),
                 std::invalid_argument);
    auto fisheye = pinhole();
    fisheye.distortion = mrpt::img::DistortionModel::kannala_brandt;
    EXPECT_THROW(CWallView(fisheye, pose, test::wallLine(2, 0)), std::invalid_argument);
    EXPECT_THROW(CWallView(pinhole(), pose, test::wallLine(std::nan(""), 0)),
                 std::invalid_argument);
}

}  // namespace
}  // namespace salma::appearance
