// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/association/CJointCompatibility.h>
#include <salma/association/CSequentialCompatibility.h>

#include <algorithm>
#include <cmath>

#include "CExhaustiveSearch.h"
#include "problems.h"

namespace salma::association {
namespace {

std::vector<int> landmarksOf(const TAssociation& result) {
    std::vector<int> landmarks;
    for (const TDecision& decision : result.decisions) landmarks.push_back(decision.landmark);
    return landmarks;
}

TEST(CJointCompatibility, FindsTheHypothesisOfExhaustiveSearch) {
    std::mt19937 random(11);
    const CJointCompatibility associator;
    std::size_t pairings = 0, losses = 0;
    for (int trial = 0; trial < 10000; ++trial) {
        const auto problem = test::smallProblem(random);
        const auto expected = test::CExhaustiveSearch(problem).mostPairings();
        const auto result = associator.associate(problem);
        ASSERT_EQ(landmarksOf(result), expected.landmarks) << "trial " << trial;
        EXPECT_NEAR(result.jointDistance2, expected.distance2, 1e-6 * (1 + expected.distance2));
        EXPECT_TRUE(result.search.complete);
        EXPECT_EQ(result.pairings, expected.pairings);
        pairings += expected.pairings;
        losses += expected.pairings < expected.individuallyCompatible;
    }
    // Otherwise nothing was searched for, or the joint gate never mattered.
    EXPECT_GT(pairings, 20000u);
    EXPECT_GT(losses, 2000u);
}

TEST(CJointCompatibility, FindsTheHypothesisOfExhaustiveSearchInSpace) {
    std::mt19937 random(21);
    const CJointCompatibility associator;
    std::size_t pairings = 0, losses = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        const auto problem = test::smallProblem3D(random);
        const auto expected = test::CExhaustiveSearch(problem).mostPairings();
        const auto result = associator.associate(problem);
        ASSERT_EQ(landmarksOf(result), expected.landmarks) << "trial " << trial;
        EXPECT_NEAR(result.jointDistance2, expected.distance2, 1e-6 * (1 + expected.distance2));
        pairings += expected.pairings;
        losses += expected.pairings < expected.individuallyCompatible;
    }
    EXPECT_GT(pairings, 5000u);
    EXPECT_GT(losses, 300u);
}

TEST(CJointCompatibility, ComesAsNearByRandomStartsWhereTheLimitStopsTheSearch) {
    std::mt19937 random(12);
    TAssociationOptions options;
    options.searchLimit = 60;
    const CJointCompatibility limited(options);
    int stopped = 0, asMany = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const auto problem = test::randomProblem(random);
        const auto expected = CJointCompatibility().associate(problem);
        const auto result = limited.associate(problem);
        if (result.search.complete) continue;
        ++stopped;
        EXPECT_LE(result.pairings, expected.pairings);
        asMany += result.pairings == expected.pairings;
        const auto again = limited.associate(problem);
        EXPECT_EQ(landmarksOf(again), landmarksOf(result));
    }
    EXPECT_GT(stopped, 20);
    EXPECT_GE(asMany, stopped * 9 / 10);
}

TEST(CJointCompatibility, TakesTheHypothesisWithMorePairings) {
    // Nearest first, the common error would be 0; only a common shift of 1 m explains all three.
    auto problem = test::problem({test::seen(3, 0), test::seen(6, 0), test::seen(9, 0)},
                                 {{2, 0}, {3.02, 0}, {5, 0}, {8, 0}});
    test::addCommonError(problem, 1, 0.01);
    for (auto& measurement : problem.measurements) measurement.R *= 0.01;
    EXPECT_EQ(landmarksOf(CJointCompatibility().associate(problem)), (std::vector<int>{0, 2, 3}));
    EXPECT_LT(CSequentialCompatibility().associate(problem).pairings, 3u);
}

TEST(CJointCompatibility, JudgesTheOthersGivenPairingsByIdentity) {
    // The identity says that ranges are 1 m longer than predicted.
    auto problem = test::problem({test::seen(5, 1), test::seen(3, 0)}, {{4, 1}, {2, 0}, {3.1, 0}});
    test::addCommonError(problem, 1, 0.01);
    for (auto& measurement : problem.measurements) measurement.R *= 0.01;
    EXPECT_EQ(CJointCompatibility().associate(problem).decisions[1].landmark, 1);
    problem.measurements.erase(problem.measurements.begin());
    EXPECT_EQ(CJointCompatibility().associate(problem).decisions[0].landmark, 2);
    problem.measurements.insert(problem.measurements.begin(), test::seen(5, 1));
    problem.measurements[0].R *= 0.01;
    problem.measurements[0].identity = problem.landmarks[0].identity = 4;
    const auto result = CJointCompatibility().associate(problem);
    EXPECT_EQ(landmarksOf(result), (std::vector<int>{0, 1}));
    EXPECT_EQ(result.decisions[0].reason, EReason::identity);
}

TEST(CJointCompatibility, StopsAtItsLimitWhereEverythingFitsEverything) {
    // 60 measurements, each of which may be any of 60 landmarks.
    std::vector<TMeasurement> measurements;
    std::vector<Eigen::Vector2d> landmarks;
    for (int i = 0; i < 60; ++i) {
        measurements.push_back(test::seen(3 + 0.001 * i, 0, 1));
        landmarks.emplace_back(3 + 0.0011 * i, 0);
    }
    const auto result = CJointCompatibility().associate(test::problem(measurements, landmarks));
    EXPECT_FALSE(result.search.complete);
    EXPECT_LE(result.search.tests, 110000u);  // twice the limit, and what one start needs
    EXPECT_GT(result.search.nodes, 0u);
    EXPECT_TRUE(std::isfinite(result.jointDistance2));
}

}  // namespace
}  // namespace salma::association
