// SPDX-License-Identifier: BSD-3-Clause
// Corridors that look alike, wheels that count badly: is the way back found, and no wrong one?
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>

#include "CCorridorWorld.h"

namespace salma::slam {
namespace {

using test::CCorridorWorld;
using test::TCorridorOptions;

struct TDrive {
    TRunRecord record;
    std::vector<Eigen::Vector3d> truth;  //!< By step.
    std::size_t features{0};
    std::size_t wrong{0};               //!< Pairings with a landmark of another feature.
    double odometryTurn{0};             //!< Error of its heading at the end [rad].
    std::vector<std::size_t> joinedAt;  //!< Steps.
    bool sound{true};                   //!< The covariance stayed symmetric, positive and finite.
};

bool isSound(CSalientEKF2D& filter) {
    const Eigen::MatrixXd P = filter.internal_getPkk().asEigen();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(P, Eigen::EigenvaluesOnly);
    return P.allFinite() && P.isApprox(P.transpose(), 1e-12) &&
           filter.internal_getXkk().asEigen().allFinite() &&
           eigen.eigenvalues().minCoeff() > -1e-9 * eigen.eigenvalues().maxCoeff();
}

/// Without walls the heading drifts so far that covariances must be stated from the robot.
TMapCare fromTheRobot() {
    TMapCare care;
    care.relocation.anchorSigma = M_PI / 180;
    care.relocation.unsure = 0.5;
    return care;
}

TDrive drive(const TCorridorOptions& options, const TMapCare& care = fromTheRobot()) {
    CCorridorWorld world(options);
    CSalientEKF2D filter({}, {}, CCorridorWorld::ratio, {}, care);
    TDrive drive;
    while (!world.done()) {
        filter.process(world.next());
        drive.truth.push_back(world.pose());
        if (drive.truth.size() % 200 == 0) drive.sound = drive.sound && isSound(filter);
    }
    filter.finish();
    drive.sound = drive.sound && isSound(filter);
    filter.results(drive.record);
    drive.features = world.features();
    drive.odometryTurn = std::abs(mrpt::math::wrapToPi(world.odometry().phi() - world.pose()[2]));
    for (const auto& row : drive.record.relocations)
        if (row.outcome == "joined") drive.joinedAt.push_back(std::lround(row.time / 0.2));
    std::map<int, std::size_t> featureOf;
    for (std::size_t i = 0; i < drive.record.associations.size(); ++i) {
        const TAssociationRow& row = drive.record.associations[i];
        if (row.landmark < 0 || row.decision == EDecision::provisional) continue;
        const auto known = featureOf.insert({row.landmark, world.truth()[i]}).first;
        drive.wrong += known->second != world.truth()[i];
    }
    return drive;
}

/// RMS distance from the true path over the steps from `from` on, after alignment [m].
double error(const TDrive& drive, std::size_t from) {
    std::vector<Eigen::Vector2d> a, b;
    Eigen::Vector2d meanA(0, 0), meanB(0, 0);
    for (std::size_t k = from; k < drive.truth.size(); ++k) {
        const auto& pose = drive.record.trajectory[k].pose;
        a.emplace_back(pose.x(), pose.y());
        b.emplace_back(drive.truth[k].head<2>());
        meanA += a.back();
        meanB += b.back();
    }
    meanA /= static_cast<double>(a.size());
    meanB /= static_cast<double>(a.size());
    Eigen::Matrix2d C = Eigen::Matrix2d::Zero();
    for (std::size_t k = 0; k < a.size(); ++k) C += (b[k] - meanB) * (a[k] - meanA).transpose();
    const double turn = std::atan2(C(1, 0) - C(0, 1), C(0, 0) + C(1, 1));
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        sum += (Eigen::Rotation2Dd(turn) * (a[k] - meanA) - (b[k] - meanB)).squaredNorm();
    return std::sqrt(sum / static_cast<double>(a.size()));
}

/// The wheels err four times as much as usual, and the filter knows it.
TCorridorOptions badWheels(std::uint32_t seed) {
    TCorridorOptions options;
    options.seed = seed;
    options.statedFactor = 4;
    return options;
}

/// By seed, each a test of its own, so that they can run side by side.
class RelocationLoop : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(RelocationLoop, ClosesAfterAHeadingErrorOfTensOfDegrees) {
    const TDrive d = drive(badWheels(GetParam()));
    EXPECT_GT(d.odometryTurn, 20 * M_PI / 180);
    EXPECT_EQ(d.wrong, 0u);
    EXPECT_EQ(d.record.landmarks.size(), d.features);  // none twice
    EXPECT_LT(error(d, d.truth.size() / 2), 0.3);
    EXPECT_TRUE(d.sound);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RelocationLoop, ::testing::Values(1U, 2U));

/// Two rings alike, first one, then the other, then both again.
TCorridorOptions twoFloors() {
    TCorridorOptions options;
    options.seed = 2;
    options.rings = 2;
    options.laps = 1;
    options.visits = 2;
    options.prints = 9;  // of 14 pictures in each ring, that hang everywhere
    options.statedFactor = 2;
    return options;
}

TEST(Relocation, FindsTheRingThatItCameFromAndDoesNotTakeOneForTheOther) {
    const TDrive d = drive(twoFloors());
    EXPECT_EQ(d.wrong, 0u);
    EXPECT_TRUE(d.sound);
    ASSERT_GE(d.joinedAt.size(), 1u);
    EXPECT_GT(d.joinedAt.front(), d.truth.size() / 2);  // not at the first visit of the second ring
    EXPECT_LT(d.record.landmarks.size(), d.features + d.features / 10);
    EXPECT_LT(error(d, d.truth.size() - 300), 0.3);
    for (const auto& row : d.record.relocations)
        EXPECT_TRUE(row.outcome == "joined" || row.outcome == "ambiguous" ||
                    row.outcome == "unproved" || row.outcome == "refused");
}

TEST(Relocation, LeavesTwoRingsApartWhereAllPicturesHangInBoth) {
    TCorridorOptions options = twoFloors();
    options.visits = 1;
    options.prints = options.posters;
    const TDrive d = drive(options);
    EXPECT_EQ(d.record.joins, 0u);
    EXPECT_EQ(d.wrong, 0u);
}

TEST(Relocation, GivesTheSameTwice) {
    const TDrive a = drive(badWheels(1)), b = drive(badWheels(1));
    ASSERT_EQ(a.record.trajectory.size(), b.record.trajectory.size());
    for (std::size_t k = 0; k < a.record.trajectory.size(); ++k) {
        EXPECT_EQ(a.record.trajectory[k].pose.x(), b.record.trajectory[k].pose.x());
        EXPECT_EQ(a.record.trajectory[k].pose.phi(), b.record.trajectory[k].pose.phi());
    }
}

TEST(Relocation, IsOffOnDemand) {
    TMapCare care;
    care.relocation.use = false;
    TCorridorOptions options = twoFloors();
    options.visits = 1;
    const TDrive d = drive(options, care);
    EXPECT_TRUE(d.record.relocations.empty());
    EXPECT_EQ(d.record.joins, 0u);
}

}  // namespace
}  // namespace salma::slam
