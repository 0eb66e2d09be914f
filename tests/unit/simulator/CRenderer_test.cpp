// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/simulator/CImageSensor.h>
#include <salma/simulator/CRenderer.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "room.h"

namespace salma::simulator {
namespace {

using mrpt::poses::CPose3D;
using test::CTemporaryFolder;

/// T_w_c of a camera at (x, y) and 1.4 m height that looks along `yaw`.
CPose3D cameraAt(double x, double y, double yaw) {
    return CPose3D(x, y, 1.4, yaw, 0, 0) + CPose3D(0, 0, 0, -M_PI / 2, 0, -M_PI / 2);
}

Eigen::Vector3d inCamera(const CPose3D& T_w_c, const Eigen::Vector3d& point) {
    Eigen::Vector3d local;
    T_w_c.inverseComposePoint(point.x(), point.y(), point.z(), local.x(), local.y(), local.z());
    return local;
}

TEST(CRenderer, ShowsAMarkerWhereTheTruthSaysInspiteOfDistortion) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, markerIni());
    world.camera.k1 = -0.2;
    const CWorld geometry(world);
    const CCameraModel camera(world.camera);
    const CRenderer renderer(geometry, camera);
    for (const CPose3D& pose :
         {cameraAt(0, 0, 0), cameraAt(1.5, -0.8, 0.1), cameraAt(2.5, 1.2, -0.7),
          cameraAt(-1, 0.3, 0.35), cameraAt(2, 0.3, -0.3)}) {
        const auto truth = camera.project(inCamera(pose, geometry.landmarks().at(0).centre));
        ASSERT_TRUE(truth) << pose;
        cv::Mat grey;
        cv::cvtColor(renderer.render(pose).colour, grey, cv::COLOR_BGR2GRAY);
        std::vector<cv::Point2f> found = {{float(truth->x()) + 2, float(truth->y()) - 2}};
        cv::cornerSubPix(grey, found, {6, 6}, {-1, -1}, {3, 100, 1e-4});
        EXPECT_NEAR(found[0].x, truth->x(), 0.25) << pose;
        EXPECT_NEAR(found[0].y, truth->y(), 0.25) << pose;
    }
}

TEST(CRenderer, APosterIsUprightAndNotMirrored) {
    const CTemporaryFolder folder;
    cv::Mat_<cv::Vec3b> quarters(64, 64);  // red green / blue white, as one looks at it
    quarters({0, 0, 32, 32}) = cv::Vec3b(0, 0, 255);
    quarters({32, 0, 32, 32}) = cv::Vec3b(0, 255, 0);
    quarters({0, 32, 32, 32}) = cv::Vec3b(255, 0, 0);
    quarters({32, 32, 32, 32}) = cv::Vec3b(255, 255, 255);
    ASSERT_TRUE(cv::imwrite((folder / "quarters.png").string(), quarters));
    // on each wall, 1 m wide, seen from the middle of the room
    const struct {
        const char* wall;
        double at, yaw;
    } cases[] = {
        {"east", 1.5, 0}, {"north", 3, M_PI / 2}, {"west", 1.5, M_PI}, {"south", 3, -M_PI / 2}};
    for (const auto& c : cases) {
        const TWorld world = load(folder, roomIni("[poster_q]\nwall = " + std::string(c.wall) +
                                                  "\nat_m = " + std::to_string(c.at) +
                                                  "\ncentre_height_m = 1.4\nwidth_m = 0.8\n"
                                                  "height_m = 0.6\ntexture = quarters.png\n"));
        const CWorld geometry(world);
        const CCameraModel camera(world.camera);
        const auto picture = CRenderer(geometry, camera).render(cameraAt(1, 0, c.yaw)).colour;
        const int x = 383, y = 245, d = 40;
        EXPECT_GT(picture(y - d, x - d)[2], 150) << c.wall;
        EXPECT_LT(picture(y - d, x - d)[1], 50) << c.wall;
        EXPECT_GT(picture(y - d, x + d)[1], 150) << c.wall;
        EXPECT_LT(picture(y - d, x + d)[2], 50) << c.wall;
        EXPECT_GT(picture(y + d, x - d)[0], 150) << c.wall;
        EXPECT_LT(picture(y + d, x - d)[2], 50) << c.wall;
        EXPECT_GT(picture(y + d, x + d)[1], 150) << c.wall;
        EXPECT_GT(picture(y + d, x + d)[2], 150) << c.wall;
    }
}

TEST(CRenderer, DepthIsTheDistanceAlongTheAxis) {
    const CTemporaryFolder folder;
    const TWorld world = load(folder, roomIni());
    const CWorld geometry(world);
    const CCameraModel camera(world.camera);
    const auto depth = CRenderer(geometry, camera).render(cameraAt(1, 0, 0)).inverseDepth;
    EXPECT_NEAR(1 / depth(246, 384), 3, 1e-4);
    EXPECT_NEAR(1 / depth(246, 30), 3, 1e-4);  // the same plane, far off the axis
}

TEST(CRenderer, LeavesNoHoleBetweenTheFacesOfAWorld) {
    const CTemporaryFolder folder;
    const TWorld world =
        load(folder,
             roomIni("[door_d]\nwall = east\nat_m = 1.5\n[box_b]\ncentre_m = 3 1\ntop_m = 0.9\n"));
    const CWorld geometry(world);
    const CCameraModel camera(world.camera);
    const CRenderer renderer(geometry, camera);
    for (double yaw = -3; yaw < 3; yaw += 0.5)
        EXPECT_EQ(cv::countNonZero(renderer.render(cameraAt(0.5, 0.2, yaw)).inverseDepth == 0), 0)
            << yaw;
}

TEST(CImageSensor, AddsTheNoiseItStatesAndNothingElseWhenStill) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, roomIni());
    world.camera.exposureSigma = world.camera.vignetting = 0;
    world.camera.noise = 3;
    const CCameraModel camera(world.camera);
    TRendering grey;
    grey.colour = cv::Mat_<cv::Vec3f>(camera.rows(), camera.columns(), cv::Vec3f(100, 100, 100));
    grey.inverseDepth = cv::Mat_<float>(camera.rows(), camera.columns(), 0.5f);
    const CImageSensor sensor(world.camera, camera, 1);
    cv::Scalar mean, sigma;
    cv::meanStdDev(sensor.develop(grey, {}, 0), mean, sigma);
    EXPECT_NEAR(mean[1], 100, 0.05);
    EXPECT_NEAR(sigma[1], std::sqrt(9 + 1 / 12.0), 0.05);  // and that of rounding
}

// A camera that moves to its right at 1 m/s for 20 ms passes a wall 2 m away by 20 mm, which is
// 0.01 f = 8.46 px: an edge is smeared over that width, its middle stays.
TEST(CImageSensor, SmearsAnEdgeByTheMotionDuringTheExposure) {
    TCameraOptions options;
    options.k1 = options.k2 = options.p1 = options.p2 = 0;
    options.exposureTime = 0.02;
    options.exposureSigma = options.vignetting = options.noise = options.blur = 0;
    const CCameraModel camera(options);
    TRendering ideal;
    ideal.colour = cv::Mat_<cv::Vec3f>(camera.rows(), camera.columns(), cv::Vec3f(0, 0, 0));
    ideal.colour.colRange(384, 768) = cv::Vec3f(200, 200, 200);
    ideal.inverseDepth = cv::Mat_<float>(camera.rows(), camera.columns(), 0.5f);
    const cv::Mat_<cv::Vec3b> picture =
        CImageSensor(options, camera, 1).develop(ideal, {{1, 0, 0}, {0, 0, 0}}, 0);
    EXPECT_EQ(picture(100, 383 - 6)[0], 0);
    EXPECT_EQ(picture(100, 384 + 6)[0], 200);
    double width = 0;  // of the ramp, from the area under it
    for (int x = 370; x < 398; ++x)
        width += picture(100, x)[0] / 200.0 * (1 - picture(100, x)[0] / 200.0);
    EXPECT_NEAR(6 * width, 8.46, 1.2);  // the integral of p (1 - p) over a ramp of width w is w / 6
}

}  // namespace
}  // namespace salma::simulator
