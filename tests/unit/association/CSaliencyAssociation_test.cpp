// SPDX-License-Identifier: BSD-3-Clause
// The search of CSaliencyAssociation; what it makes of it is in methods_test.cpp.
#include <gtest/gtest.h>
#include <salma/association/CSaliencyAssociation.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <vector>

#include "CExhaustiveSearch.h"
#include "problems.h"

namespace salma::association {
namespace {

/// The problem with some appearance, and landmarks that are seen more or less easily.
template <int DIM>
TAssociationProblemOf<DIM> described(TAssociationProblemOf<DIM> problem, std::mt19937& random) {
    std::uniform_real_distribution<double> ratio(-4, 4);
    std::uniform_real_distribution<double> detection(0.02, 0.98);
    // Those that show each other have equal indices.
    const std::size_t salient = random() % 5;
    for (std::size_t i = 0; i < problem.measurements.size() && i < salient; ++i)
        problem.measurements[i].kind = ELandmarkKind::salient;
    for (std::size_t j = 0; j < problem.landmarks.size() && j < salient; ++j)
        problem.landmarks[j].kind = ELandmarkKind::salient;
    std::vector<double> ratios(36);
    for (double& value : ratios) value = random() % 4 == 0 ? std::nan("") : ratio(random);
    for (auto& landmark : problem.landmarks)
        if (random() % 4 != 0) landmark.detection = {detection(random), detection(random)};
    problem.logRatio = [ratios](std::size_t i, std::size_t j) { return ratios[6 * i + j]; };
    return problem;
}

struct TCounts {
    std::size_t paired{0}, ambiguous{0}, created{0}, left{0};
};

TAssociationProblem describedProblem(std::mt19937& random) {
    return described(test::smallProblem(random), random);
}

template <int DIM>
void compare(const TAssociationProblemOf<DIM>& problem,
             const TAssociationOptions& options,
             TCounts& counts) {
    const auto expected = test::CExhaustiveSearch(problem).bestScored(options);
    const auto result = CSaliencyAssociation(options).associate(problem);
    ASSERT_TRUE(result.search.complete);
    ASSERT_NEAR(result.score, expected.score, 1e-6);
    for (std::size_t i = 0; i < expected.landmarks.size(); ++i) {
        const TDecision& decision = result.decisions[i];
        ASSERT_EQ(decision.reason == EReason::ambiguous, expected.ambiguous[i])
            << "measurement " << i;
        counts.ambiguous += expected.ambiguous[i];
        counts.created += decision.verdict == EVerdict::created;
        counts.left += expected.landmarks[i] >= 0 && decision.verdict != EVerdict::paired;
        if (decision.verdict != EVerdict::paired) continue;
        ++counts.paired;
        ASSERT_EQ(decision.landmark, expected.landmarks[i]);
    }
}

TEST(CSaliencyAssociation, FindsTheHypothesisAndTheDoubtsOfExhaustiveSearch) {
    std::mt19937 random(21);
    TAssociationOptions options;
    options.acceptLogLr = -1.9;
    options.detectionProbability = 0.8;
    TCounts counts;
    for (int trial = 0; trial < 4000; ++trial) {
        SCOPED_TRACE(trial);
        // Clutter beside new landmarks, and neither worth a thought.
        options.cornerClutterLogDensity = trial % 2 == 0 ? -6 : 1;
        options.cornerLogDensity = trial % 3 == 0 ? 2 : -2;
        compare(describedProblem(random), options, counts);
        if (HasFatalFailure()) return;
    }
    // Otherwise nothing was decided, or nothing was doubtful.
    EXPECT_GT(counts.paired, 2000u);
    EXPECT_GT(counts.ambiguous, 2000u);
    EXPECT_GT(counts.created, 500u);
    std::cout << counts.paired << " paired, " << counts.ambiguous << " ambiguous, "
              << counts.created << " new, " << counts.left << " held back" << std::endl;
}

TEST(CSaliencyAssociation, FindsTheHypothesisAndTheDoubtsOfExhaustiveSearchInSpace) {
    std::mt19937 random(22);
    TAssociationOptions options;
    options.acceptLogLr = -1.9;
    options.detectionProbability = 0.8;
    TCounts counts;
    for (int trial = 0; trial < 2000; ++trial) {
        SCOPED_TRACE(trial);
        options.cornerLogDensity = trial % 3 == 0 ? 2 : -2;
        compare(described(test::smallProblem3D(random), random), options, counts);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(counts.paired, 1000u);
    EXPECT_GT(counts.ambiguous, 300u);
    EXPECT_GT(counts.created, 300u);
    std::cout << counts.paired << " paired, " << counts.ambiguous << " ambiguous, "
              << counts.created << " new, " << counts.left << " held back" << std::endl;
}

TEST(CSaliencyAssociation, PrefersLandmarksThatAreInView) {
    auto problem = test::problem({test::seen(2, 0)}, {{1.95, 0}, {2.05, 0}});
    TAssociationOptions options;
    options.detectionProbability = 0.97;
    problem.landmarks[0].detection = {0, 0.97};
    EXPECT_EQ(CSaliencyAssociation(options).associate(problem).decisions[0].landmark, 1);
    options.searchLimit = 1;  // the surest first
    options.cornerLogDensity = -10;
    EXPECT_EQ(CSaliencyAssociation(options).associate(problem).decisions[0].landmark, 1);
    // What is hard to find says little by not being found.
    options.searchLimit = 1000;
    for (auto& landmark : problem.landmarks) landmark.detection = {1, 0.3};
    problem.landmarks[0].detection->inView = 0;
    EXPECT_EQ(CSaliencyAssociation(options).associate(problem).decisions[0].reason,
              EReason::ambiguous);
    problem.landmarks[1].detection.reset();
    problem.landmarks[0].detection.reset();
    EXPECT_EQ(CSaliencyAssociation(options).associate(problem).decisions[0].reason,
              EReason::ambiguous);
}

TEST(CSaliencyAssociation, RefusesADetectionThatIsNoProbability) {
    for (const double bad : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
        auto problem = test::problem({test::seen(2, 0)}, {{2, 0}});
        problem.landmarks[0].detection = {bad, 0.5};
        EXPECT_THROW(CSaliencyAssociation().associate(problem), std::invalid_argument);
        problem.landmarks[0].detection = {0.5, bad};
        EXPECT_THROW(CSaliencyAssociation().associate(problem), std::invalid_argument);
    }
}

TEST(CSaliencyAssociation, GoesOnWithTheSurestFirstWhereTheLimitStopsTheSearch) {
    std::mt19937 random(22);
    TAssociationOptions options;
    options.cornerLogDensity = -10;  // leaves the decision to the margin
    const CSaliencyAssociation whole(options);
    options.searchLimit = 1;
    const CSaliencyAssociation limited(options);
    std::size_t paired = 0, same = 0, expectedPairs = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const auto problem = test::randomProblem(random);
        const auto expected = whole.associate(problem);
        const auto result = limited.associate(problem);
        EXPECT_FALSE(result.search.complete);
        expectedPairs += expected.pairings;
        for (std::size_t i = 0; i < result.decisions.size(); ++i) {
            if (result.decisions[i].landmark < 0) continue;
            ++paired;
            same += result.decisions[i].landmark == expected.decisions[i].landmark;
        }
    }
    EXPECT_GT(paired, expectedPairs / 2);
    EXPECT_GT(same, paired * 9 / 10);
    std::cout << expectedPairs << " by search, " << paired << " without, " << same << " the same"
              << std::endl;
}

TEST(CSaliencyAssociation, StopsAtItsLimitWhereEverythingFitsEverything) {
    std::vector<TMeasurement> measurements;
    std::vector<Eigen::Vector2d> landmarks;
    for (int i = 0; i < 150; ++i) {
        measurements.push_back(test::seen(3 + 0.001 * i, 0, 1));
        landmarks.emplace_back(3 + 0.0011 * i, 0);
    }
    const auto result = CSaliencyAssociation().associate(test::problem(measurements, landmarks));
    EXPECT_FALSE(result.search.complete);
    EXPECT_LE(result.search.tests,
              2 * (50000u + 150 * 150));  // one look at all may pass the limit
    EXPECT_EQ(result.pairings, 0u);
    EXPECT_EQ(result.decisions[0].reason, EReason::improbable);
}

TEST(CSaliencyAssociation, HoldsThatANewCornerBesideTheRightPosterIsNoReasonForTheWrongOne) {
    // Two equal posters, 2 m apart; the corner fits an old one only if the wrong one is seen. That
    // it is new where the right one is seen must count as much.
    auto problem =
        test::problem({test::poster(5, 0, 0.05), test::seen(6, 0.5, 0.05)}, {{4.5, 0.5}});
    for (const double range : {4.5, 6.5}) {
        TPredictedLandmark poster;
        poster.kind = ELandmarkKind::salient;
        poster.z << range, 0;
        problem.landmarks.push_back(poster);
    }
    problem.landmarks[0].z[0] = 7.5;
    problem.predictionCovariance = Eigen::MatrixXd::Zero(6, 6);
    test::addCommonError(problem, 1, 0.01);
    const auto result = CSaliencyAssociation().associate(problem);
    EXPECT_EQ(result.decisions[0].reason, EReason::ambiguous);
}

}  // namespace
}  // namespace salma::association
