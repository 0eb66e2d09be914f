// SPDX-License-Identifier: BSD-3-Clause
#include "measurements.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

namespace salma::apps {
namespace {

using mrpt::math::TPoint2D;

laser::TCorner cornerAt(double x, double y) {
    laser::TCorner corner;
    corner.position = {x, y};
    corner.covariance << 4e-4, -1.5e-4, -1.5e-4, 1e-4;
    corner.convex = true;
    return corner;
}

association::TMeasurement measured(const laser::TCorner& corner) {
    slam::TStepInput step;
    addCorner(corner, step);
    return step.measurements.at(0);
}

Eigen::Vector2d polar(double x, double y) { return {std::hypot(x, y), std::atan2(y, x)}; }

/// Ahead, to all sides, and close to where the bearing jumps from pi to -pi.
const TPoint2D kPlaces[] = {{3, 0}, {2, 1}, {-0.5, 4}, {-6, -0.001}, {-3, 0.002}, {0.1, -0.7}};

TEST(AddCorner, GivesTheCovarianceOfNumericalDifferences) {
    for (const auto& p : kPlaces) {
        const auto corner = cornerAt(p.x, p.y);
        constexpr double h = 1e-5;
        Eigen::Matrix2d J;
        J.col(0) = (polar(p.x + h, p.y) - polar(p.x - h, p.y)) / (2 * h);
        J.col(1) = (polar(p.x, p.y + h) - polar(p.x, p.y - h)) / (2 * h);
        const Eigen::Matrix2d expected = J * corner.covariance * J.transpose();
        const auto m = measured(corner);
        EXPECT_LT((m.R - expected).norm(), 1e-6 * expected.norm()) << p.x << " " << p.y;
        EXPECT_DOUBLE_EQ(m.z(0), std::hypot(p.x, p.y));
        EXPECT_DOUBLE_EQ(m.z(1), std::atan2(p.y, p.x));
    }
}

TEST(AddCorner, GivesTheCovarianceOfDrawnCorners) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    constexpr int kDraws = 20000;
    for (const auto& p : kPlaces) {
        const auto corner = cornerAt(p.x, p.y);
        const auto m = measured(corner);
        const Eigen::Matrix2d L = corner.covariance.llt().matrixL();
        Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
        for (int i = 0; i < kDraws; ++i) {
            const double a = normal(random), b = normal(random);
            const Eigen::Vector2d d = L * Eigen::Vector2d(a, b);
            Eigen::Vector2d e = polar(p.x + d(0), p.y + d(1)) - m.z;
            e(1) = mrpt::math::wrapToPi(e(1));
            sum += e * e.transpose();
        }
        // whitened, the drawn covariance is the identity but for its own scatter: an entry has
        // sigma sqrt(2 / kDraws) = 1 %
        const Eigen::Matrix2d W = m.R.llt().matrixL().solve(Eigen::Matrix2d::Identity());
        const Eigen::Matrix2d white = W * (sum / kDraws) * W.transpose();
        EXPECT_LT((white - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff(), 0.05)
            << p.x << " " << p.y << "\n"
            << white;
    }
}

TEST(AddCorner, AppendsACornerWithoutAPlaceInThePicture) {
    slam::TStepInput step;
    addCorner(cornerAt(2, 1), step);
    auto nook = cornerAt(1, 2);
    nook.convex = false;
    addCorner(nook, step);
    ASSERT_EQ(step.measurements.size(), 2U);
    ASSERT_EQ(step.spots.size(), 2U);
    EXPECT_EQ(step.measurements[0].kind, association::ELandmarkKind::corner);
    EXPECT_TRUE(step.measurements[0].convex);
    EXPECT_FALSE(step.measurements[1].convex);
    EXPECT_EQ(step.measurements[0].patch, nullptr);
    for (const auto& spot : step.spots)
        EXPECT_TRUE(std::isnan(spot.pixel.x) && std::isnan(spot.pixel.y) &&
                    std::isnan(spot.axisAngle));
}

TEST(AddCorner, LeavesOutACornerAtTheRobotWhichHasNoBearing) {
    slam::TStepInput step;
    addCorner(cornerAt(0, 0), step);
    addCorner(cornerAt(std::nan(""), 1), step);
    EXPECT_TRUE(step.measurements.empty());
    EXPECT_TRUE(step.spots.empty());
}

constexpr double kFocal = 500, kCx = 320, kCy = 240;  // of a pin-hole camera [px]

/// Picture of a point of a wall patch: u to the right, v up from its centre [m]; the centre is at
/// (0.3, -0.2, 2.5) in the camera's frame and the wall is turned by 50 degrees about the vertical.
TPoint2D project(double u, double v) {
    const double turn = 50 * M_PI / 180;
    const double x = 0.3 + u * std::cos(turn), y = -0.2 - v, z = 2.5 + u * std::sin(turn);
    return {kCx + kFocal * x / z, kCy + kFocal * y / z};
}

/// The patch of 1.2 m by 0.8 m in that picture, 3 m ahead of the robot and 1 m to its left.
observations::TPatch slantedPatch() {
    observations::TPatch patch;
    patch.quad = {project(-0.6, 0.4), project(0.6, 0.4), project(0.6, -0.4), project(-0.6, -0.4)};
    patch.pose.mean = mrpt::poses::CPose3D(3, 1, 0.5, -1.2, 0, M_PI_2);
    patch.pose.cov.setDiagonal(0.01);
    return patch;
}

TEST(CentreOf, IsThePictureOfTheCentreOfASlantedRectangle) {
    const auto patch = slantedPatch();
    const auto centre = centreOf(patch);
    EXPECT_NEAR(centre.x, 320 + 500 * 0.3 / 2.5, 1e-9);  // (380, 200)
    EXPECT_NEAR(centre.y, 240 - 500 * 0.2 / 2.5, 1e-9);
    TPoint2D mean;
    for (const auto& corner : patch.quad) mean += corner * 0.25;
    EXPECT_GT((mean - centre).norm(), 5) << "too flat a view to tell the centre from the mean";
}

TEST(CentreOf, IsACornerOfAQuadWithoutArea) {
    observations::TPatch patch;
    patch.quad = {TPoint2D(5, 6), TPoint2D(5, 6), TPoint2D(5, 6), TPoint2D(5, 6)};
    EXPECT_EQ(centreOf(patch), TPoint2D(5, 6));
    patch.quad = {TPoint2D(1, 2), TPoint2D(2, 4), TPoint2D(3, 6), TPoint2D(4, 8)};
    EXPECT_EQ(centreOf(patch), TPoint2D(1, 2));
}

/// A camera above the middle of the robot that looks ahead and 30 degrees to the left.
const mrpt::poses::CPose3D kCamera = mrpt::poses::CPose3D(0, 0, 1.2, M_PI / 6, 0, 0) +
                                     mrpt::poses::CPose3D(0, 0, 0, -M_PI_2, 0, -M_PI_2);

TEST(AddPatch, AppendsTheCentreInThePictureAndAPatchOfItsOwn) {
    slam::TStepInput step;
    addCorner(cornerAt(2, 1), step);
    {
        auto patch = slantedPatch();
        addPatch(patch, kCamera, step);
        patch.quad = {};  // what was appended does not look back at it
    }
    ASSERT_EQ(step.measurements.size(), 2U);
    ASSERT_EQ(step.spots.size(), 2U);
    const auto& m = step.measurements[1];
    EXPECT_EQ(m.kind, association::ELandmarkKind::salient);
    EXPECT_NEAR(m.z(0), std::sqrt(10), 1e-12);
    EXPECT_NEAR(m.z(1), std::atan2(1, 3), 1e-12);
    EXPECT_NEAR(m.R(0, 0), 0.01, 1e-12);       // 0.1 m along the ray
    EXPECT_NEAR(m.R(1, 1), 0.01 / 10, 1e-12);  // 0.1 m across it, from sqrt(10) m
    EXPECT_NEAR(m.wallAngleSigma, 0.1, 1e-12);
    ASSERT_NE(m.patch, nullptr);
    EXPECT_EQ(m.patch->quad, slantedPatch().quad);
    EXPECT_NEAR(step.spots[1].pixel.x, 380, 1e-9);
    EXPECT_NEAR(step.spots[1].pixel.y, 200, 1e-9);
    // 18.43 degrees to the left of the robot's axis, and the camera looks 30 degrees to the left
    EXPECT_NEAR(step.spots[1].axisAngle, M_PI / 6 - std::atan2(1, 3), 1e-12);
}

TEST(AddPatch, LeavesTheStepAsItWasIfThePatchHasNoBearing) {
    auto patch = slantedPatch();
    patch.pose.mean = mrpt::poses::CPose3D(0, 0, 1, 0, 0, M_PI_2);
    slam::TStepInput step;
    EXPECT_THROW(addPatch(patch, kCamera, step), std::invalid_argument);
    EXPECT_TRUE(step.measurements.empty());
    EXPECT_TRUE(step.spots.empty());
}

}  // namespace
}  // namespace salma::apps
