// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/simulator/CCameraModel.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

namespace salma::simulator {
namespace {

TCameraOptions distorted() {
    TCameraOptions options;
    options.k1 = -0.2;
    options.k2 = 0.08;
    options.k3 = -0.01;
    options.p1 = 0.002;
    options.p2 = -0.001;
    return options;
}

TEST(CCameraModel, HasTheFieldOfTheEviD30AcrossThePicture) {
    const CCameraModel camera{TCameraOptions()};
    const auto& k = camera.parameters();
    EXPECT_EQ(k.ncols, 768u);
    EXPECT_EQ(k.nrows, 492u);
    EXPECT_NEAR(2 * std::atan(768 / 2 / k.fx()) * 180 / M_PI, 48.8, 1e-9);
    EXPECT_DOUBLE_EQ(k.cx(), 383.5);  // pixel centres are at integers
    EXPECT_DOUBLE_EQ(k.fx(), k.fy());
}

TEST(CCameraModel, ProjectsAsOpenCvDoes) {
    const CCameraModel camera(distorted());
    const auto& c = camera.parameters();
    const cv::Matx33d k(c.fx(), 0, c.cx(), 0, c.fy(), c.cy(), 0, 0, 1);
    const std::vector<double> distortion = {c.k1(), c.k2(), c.p1(), c.p2(), c.k3()};
    for (const cv::Point3d p :
         {cv::Point3d(0, 0, 2), cv::Point3d(0.8, -0.4, 2), cv::Point3d(-1.6, 1, 4)}) {
        std::vector<cv::Point2d> expected;
        cv::projectPoints(std::vector<cv::Point3d>{p}, cv::Vec3d(), cv::Vec3d(), k, distortion,
                          expected);
        const auto pixel = camera.project({p.x, p.y, p.z});
        ASSERT_TRUE(pixel);
        EXPECT_NEAR(pixel->x(), expected[0].x, 1e-9);
        EXPECT_NEAR(pixel->y(), expected[0].y, 1e-9);
    }
}

TEST(CCameraModel, UndistortInvertsDistortInAllOfThePicture) {
    const CCameraModel camera(distorted());
    for (int y = 0; y < 492; y += 41)
        for (int x = 0; x < 768; x += 59)
            EXPECT_NEAR(
                (camera.distort(camera.undistort(Eigen::Vector2d(x, y))) - Eigen::Vector2d(x, y))
                    .norm(),
                0, 1e-8);
}

TEST(CCameraModel, DoesNotProjectWhatIsBehindOrBesideThePicture) {
    const CCameraModel camera(distorted());
    EXPECT_TRUE(camera.project({0, 0, 1}));
    EXPECT_FALSE(camera.project({0, 0, -1}));
    EXPECT_FALSE(camera.project({1, 0, 1}));
    EXPECT_FALSE(camera.project({30, 0, 1}));  // where the polynomial folds back
}

TEST(CCameraModel, RefusesADistortionThatFoldsOverInThePicture) {
    TCameraOptions options;
    options.horizontalField = 2;
    options.k1 = -0.5;
    options.k2 = options.k3 = 0;
    EXPECT_THROW(CCameraModel{options}, std::invalid_argument);
}

}  // namespace
}  // namespace salma::simulator
