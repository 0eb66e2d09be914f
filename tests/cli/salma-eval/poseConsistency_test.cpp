// SPDX-License-Identifier: BSD-3-Clause
#include "poseConsistency.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

namespace salma::apps {
namespace {

using mrpt::poses::CPose2D;

const CPose2D kStart(5, -2, 1);  // of the map's frame, in the truth's
constexpr double kMaxGap = 0.5;

/// A straight drive of `n` poses, 0.1 s apart, in the frame of its first pose.
std::vector<CPose2D> drive(std::size_t n) {
    std::vector<CPose2D> poses;
    for (std::size_t i = 0; i < n; ++i)
        poses.emplace_back(0.05 * static_cast<double>(i), 0, 0.01 * static_cast<double>(i));
    return poses;
}

viz::TTrajectory truthOf(const std::vector<CPose2D>& poses) {
    viz::TTrajectory truth;
    for (std::size_t i = 0; i < poses.size(); ++i)
        truth.push_back({100 + 0.1 * static_cast<double>(i), kStart + poses[i]});
    return truth;
}

slam::TTrajectoryRow rowAt(std::size_t i, const CPose2D& pose, const Eigen::Matrix3d& covariance) {
    slam::TTrajectoryRow row;
    row.time = 100 + 0.1 * static_cast<double>(i);
    row.running = pose;
    row.covariance = covariance;
    return row;
}

TEST(PoseConsistency, MeasuresErrorsInTheFrameOfTheFirstPose) {
    const auto poses = drive(4);
    const Eigen::Matrix3d P = Eigen::Vector3d(0.01, 0.04, 0.09).asDiagonal();
    const CPose2D wrong(poses[3].x() + 0.1, poses[3].y() - 0.4, poses[3].phi() + 0.3);
    slam::TRunRecord record;
    record.trajectory = {rowAt(0, poses[0], Eigen::Matrix3d::Zero()), rowAt(1, poses[1], P),
                         rowAt(3, wrong, P)};
    const auto result = poseConsistency(record, truthOf(poses), kMaxGap);
    EXPECT_EQ(result.steps, 2u) << "a certain pose has no NEES";
    EXPECT_NEAR(result.meanNees, (0 + 1 + 4 + 1) / 2.0, 1e-9);
    EXPECT_NEAR(result.finalError, std::hypot(0.1, 0.4), 1e-9);
    EXPECT_NEAR(result.maxJump, std::hypot(0.1, 0.4), 1e-9);
    EXPECT_TRUE(std::isnan(result.at[0]));
    EXPECT_NEAR(result.at[6], 0, 1e-9) << "a third of the way";
    EXPECT_NEAR(result.at[19], 6, 1e-9);
}

TEST(PoseConsistency, HasMeanThreeIfTheCovarianceIsTrue) {
    Eigen::Matrix3d P;
    P << 0.04, 0.01, 0.002, 0.01, 0.09, -0.003, 0.002, -0.003, 0.001;
    const Eigen::Matrix3d L = P.llt().matrixL();
    const auto poses = drive(4001);
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    slam::TRunRecord record;
    record.trajectory.push_back(rowAt(0, poses[0], Eigen::Matrix3d::Zero()));
    for (std::size_t i = 1; i < poses.size(); ++i) {
        const Eigen::Vector3d e =
            L * Eigen::Vector3d(normal(random), normal(random), normal(random));
        record.trajectory.push_back(
            rowAt(i, CPose2D(poses[i].x() + e[0], poses[i].y() + e[1], poses[i].phi() + e[2]), P));
    }
    const auto result = poseConsistency(record, truthOf(poses), kMaxGap);
    EXPECT_EQ(result.steps, 4000u);
    EXPECT_NEAR(result.meanNees, 3, 4 * std::sqrt(6.0 / 4000));  // variance of chi2(3) is 6
}

TEST(PoseConsistency, WrapsTheHeading) {
    const std::vector<CPose2D> poses{CPose2D(0, 0, 0), CPose2D(1, 0, M_PI - 0.01)};
    slam::TRunRecord record;
    record.trajectory = {
        rowAt(0, poses[0], Eigen::Matrix3d::Zero()),
        rowAt(1, CPose2D(1, 0, -M_PI + 0.01), 0.0004 * Eigen::Matrix3d::Identity())};
    EXPECT_NEAR(poseConsistency(record, truthOf(poses), kMaxGap).meanNees, 1, 1e-6);
}

TEST(PoseConsistency, LeavesOutWhatHasNoTruthOrNoRegularCovariance) {
    const auto poses = drive(3);
    Eigen::Matrix3d singular = Eigen::Matrix3d::Constant(0.01);
    Eigen::Matrix3d notFinite = Eigen::Matrix3d::Identity();
    notFinite(0, 1) = std::nan("");
    slam::TRunRecord record;
    record.trajectory = {rowAt(0, poses[0], singular), rowAt(1, poses[1], notFinite),
                         rowAt(2, poses[2], -Eigen::Matrix3d::Identity()),
                         rowAt(50, poses[2], Eigen::Matrix3d::Identity())};
    const auto result = poseConsistency(record, truthOf(poses), kMaxGap);
    EXPECT_EQ(result.steps, 0u);
    EXPECT_TRUE(std::isnan(result.meanNees));
    EXPECT_NEAR(result.finalError, 0, 1e-9);
    EXPECT_TRUE(std::isnan(poseConsistency({}, truthOf(poses), kMaxGap).finalError));
}

}  // namespace
}  // namespace salma::apps
