// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/COdometryNoise.h>
#include <salma/slam/rangeBearingModel.h>

#include <cmath>

namespace salma::slam {
namespace {

TOdometryOptions withoutFloor() {
    TOdometryOptions options;
    options.minPosition = options.minHeading = 0;
    return options;
}

TEST(COdometryNoise, GivesTheStatedDeviationAfterOneMetreAndOneRadian) {
    TOdometryOptions options = withoutFloor();
    options.alongPerMetre = 0.1;
    options.acrossPerMetre = 0.2;
    options.headingPerMetre = 0.3;
    options.headingPerRadian = 0.4;
    const COdometryNoise noise(options);
    const auto straight = noise.increment({1, 0, 0});
    EXPECT_NEAR(straight.cov(0, 0), 0.01, 1e-12);
    EXPECT_NEAR(straight.cov(1, 1), 0.04, 1e-12);
    EXPECT_NEAR(straight.cov(2, 2), 0.09, 1e-12);
    EXPECT_NEAR(noise.increment({0, 0, -1}).cov(2, 2), 0.16, 1e-12);
    const auto sideways = noise.increment({0, -1, 0});
    EXPECT_NEAR(sideways.cov(0, 0), 0.04, 1e-12);
    EXPECT_NEAR(sideways.cov(1, 1), 0.01, 1e-12);
}

TEST(COdometryNoise, DoesNotDependOnHowAPathIsCut) {
    const COdometryNoise noise(withoutFloor());
    const auto covarianceAfter = [&](int steps) {
        Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
        Eigen::Vector3d pose(0, 0, 0);
        for (int i = 0; i < steps; ++i) {
            const auto inc = noise.increment({10.0 / steps, 0, 0});
            const TMotion motion = moved(pose, {inc.mean.x(), 0, 0});
            P = motion.byPose * P * motion.byPose.transpose() + inc.cov.asEigen();
            pose = motion.pose;
        }
        return P;
    };
    const Eigen::Matrix3d coarse = covarianceAfter(500);
    const Eigen::Matrix3d fine = covarianceAfter(2000);
    EXPECT_TRUE(coarse.isApprox(fine, 0.01));
    // Random walk of the heading: lateral variance s^2 L^3 / 3 plus the lateral noise.
    const TOdometryOptions o;
    const double lateral =
        o.headingPerMetre * o.headingPerMetre * 1000 / 3 + o.acrossPerMetre * o.acrossPerMetre * 10;
    EXPECT_NEAR(fine(1, 1), lateral, 0.01 * lateral);
}

TEST(COdometryNoise, GivesARobotAtRestNoNoise) {
    EXPECT_EQ(COdometryNoise().increment({0, 0, 0}).cov.asEigen(), Eigen::Matrix3d::Zero());
}

TEST(COdometryNoise, KeepsTheMotion) {
    const auto moved = COdometryNoise().increment({0.3, -0.1, 0.2});
    EXPECT_EQ(moved.mean.x(), 0.3);
    EXPECT_EQ(moved.mean.y(), -0.1);
    EXPECT_NEAR(moved.mean.phi(), 0.2, 1e-12);
}

}  // namespace
}  // namespace salma::slam
