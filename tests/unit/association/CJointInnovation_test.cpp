// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/association/CJointInnovation.h>

#include <Eigen/LU>
#include <cmath>

#include "problems.h"

namespace salma::association {
namespace {

TEST(CJointInnovation, WrapsTheBearingAcrossTheHalfTurn) {
    const Eigen::Vector2d nu =
        innovation(Eigen::Vector2d(2, M_PI - 0.05), Eigen::Vector2d(1.5, -M_PI + 0.05));
    EXPECT_NEAR(nu[0], 0.5, 1e-12);
    EXPECT_NEAR(nu[1], -0.1, 1e-12);
}

TEST(CJointInnovation, WrapsYawAndPitchInSpace) {
    const Eigen::Vector3d nu =
        innovation(Eigen::Vector3d(2, M_PI - 0.05, 0.3), Eigen::Vector3d(1.5, -M_PI + 0.05, 0.1));
    EXPECT_NEAR((nu - Eigen::Vector3d(0.5, -0.1, 0.2)).norm(), 0, 1e-12);
}

TEST(CJointInnovation, StatesTheDensityOfThreeDimensions) {
    // S = 0.01 I; nu = (0.2, 0.1, 0.1): d2 = 6. log N = -3 - 1.5 log(2 pi 0.01).
    TAssociationProblem3D problem;
    problem.measurements.resize(1);
    problem.measurements[0].z << 2.2, 0.1, -0.1;
    problem.measurements[0].R *= 0.01;
    problem.landmarks.resize(1);
    problem.landmarks[0].z << 2, 0, -0.2;
    problem.predictionCovariance = Eigen::Matrix3d::Zero();
    const auto tested = CJointInnovationOf<3>(problem).test(0, 0);
    ASSERT_TRUE(tested);
    EXPECT_NEAR(tested->distance2, 6, 1e-9);
    EXPECT_NEAR(tested->logDensity, -3 - 1.5 * std::log(2 * M_PI * 0.01), 1e-9);
}

TEST(CJointInnovation, TestsTheFirstPairingByItself) {
    // S = 0.01 I; nu = (0.2, 0.1): d2 = 4 + 1. log N = -2.5 - log(2 pi 0.01).
    const auto problem = test::problem({test::seen(2.2, 0.1)}, {{2, 0}});
    const auto tested = CJointInnovation(problem).test(0, 0);
    ASSERT_TRUE(tested);
    EXPECT_NEAR(tested->distance2, 5, 1e-9);
    EXPECT_NEAR(tested->logDensity, -2.5 - std::log(2 * M_PI * 0.01), 1e-9);
}

TEST(CJointInnovation, SumsConditionalDistancesToTheJointOne) {
    std::mt19937 random(1);
    const auto problem = test::randomProblem(random);
    CJointInnovation joint(problem);
    double sum = 0;
    Eigen::VectorXd nu(8);
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(8, 8);
    for (Eigen::Index k = 0; k < 4; ++k) {
        const std::size_t landmark = 5 - static_cast<std::size_t>(k);
        sum += joint.test(static_cast<std::size_t>(k), landmark)->distance2;
        ASSERT_TRUE(joint.add(static_cast<std::size_t>(k), landmark));
        nu.segment<2>(2 * k) = innovation(problem.measurements[k].z, problem.landmarks[landmark].z);
        for (Eigen::Index l = 0; l < 4; ++l)
            S.block<2, 2>(2 * k, 2 * l) =
                problem.predictionCovariance.block<2, 2>(2 * (5 - k), 2 * (5 - l));
        S.block<2, 2>(2 * k, 2 * k) += problem.measurements[k].R;
    }
    const double whole = nu.dot(S.inverse() * nu);
    EXPECT_NEAR(joint.distance2(), whole, 1e-9 * whole);
    EXPECT_NEAR(sum, whole, 1e-9 * whole);
    EXPECT_EQ(joint.pairings(), 4u);
}

TEST(CJointInnovation, FindsNothingWhereTheCovarianceIsNotPositiveDefinite) {
    auto problem = test::problem({test::seen(2, 0)}, {{2, 0}});
    problem.predictionCovariance = -Eigen::Matrix2d::Identity();
    CJointInnovation joint(problem);
    EXPECT_FALSE(joint.test(0, 0));
    EXPECT_FALSE(joint.add(0, 0));
    EXPECT_EQ(joint.pairings(), 0u);
}

}  // namespace
}  // namespace salma::association
