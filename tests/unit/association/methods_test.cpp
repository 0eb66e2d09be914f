// SPDX-License-Identifier: BSD-3-Clause
// What tells the methods apart.
#include <gtest/gtest.h>
#include <salma/association/CNearestNeighbour.h>
#include <salma/association/CSaliencyAssociation.h>
#include <salma/association/CSequentialCompatibility.h>

#include <cmath>
#include <map>

#include "problems.h"

namespace salma::association {
namespace {

TEST(CNearestNeighbour, GivesALandmarkThatTwoWantToTheNearer) {
    const auto result = CNearestNeighbour().associate(
        test::problem({test::seen(2.1, 0), test::seen(2.05, 0)}, {{2, 0}, {2.3, 0}}));
    EXPECT_EQ(result.decisions[1].landmark, 0);
    EXPECT_EQ(result.decisions[0].landmark, 1);
    EXPECT_EQ(result.decisions[0].candidates, 2u);
    EXPECT_EQ(result.candidates.size(), 4u);
}

TEST(CNearestNeighbour, SaysThatTheOnlyCandidateIsTaken) {
    const auto result = CNearestNeighbour().associate(
        test::problem({test::seen(2.1, 0), test::seen(2.05, 0)}, {{2, 0}}));
    EXPECT_EQ(result.decisions[0].verdict, EVerdict::deferred);
    EXPECT_EQ(result.decisions[0].reason, EReason::taken);
}

/// Two landmarks shifted in opposite directions though their errors are common: each is inside its
/// own gate (1 / 0.51 = 1.96), together they are not (nu1 - nu2 = 2, variance 0.02: d2 > 100).
TAssociationProblem opposite() {
    auto problem = test::problem({test::seen(3, 0), test::seen(4, 1)}, {{2, 0}, {5, 1}});
    test::addCommonError(problem, std::sqrt(0.5), 0.01);
    return problem;
}

TEST(CSequentialCompatibility, DropsWhatIsOnlyIndividuallyCompatible) {
    EXPECT_EQ(CNearestNeighbour().associate(opposite()).decisions[1].verdict, EVerdict::paired);
    const auto result = CSequentialCompatibility().associate(opposite());
    int paired = 0;
    for (const TDecision& decision : result.decisions) {
        paired += decision.verdict == EVerdict::paired;
        if (decision.verdict != EVerdict::paired) {
            EXPECT_EQ(decision.reason, EReason::jointlyImpossible);
        }
    }
    EXPECT_EQ(paired, 1);
    EXPECT_EQ(result.dropped.joint, 1u);
    EXPECT_LE(result.jointDistance2, 9.21);
}

TEST(CSequentialCompatibility, KeepsWhatTheCommonErrorExplains) {
    auto problem = opposite();
    problem.measurements[1].z[0] = 6;  // shifted the same way
    const auto result = CSequentialCompatibility().associate(problem);
    EXPECT_EQ(result.decisions[0].landmark, 0);
    EXPECT_EQ(result.decisions[1].landmark, 1);
    // Mean shift 1 of variance 0.5 + 0.005: d2 = 1 / 0.505; no difference between the two.
    EXPECT_NEAR(result.jointDistance2, 1 / 0.505, 1e-9);
}

/// One poster between two landmarks of the map at equal distance.
TAssociationProblem between(double firstRatio, double secondRatio) {
    auto problem =
        test::problem({test::poster(2, 0)}, {{1.9, 0}, {2.1, 0}}, ELandmarkKind::salient);
    problem.logRatio = [=](std::size_t, std::size_t landmark) {
        return landmark == 0 ? firstRatio : secondRatio;
    };
    return problem;
}

TEST(CSaliencyAssociation, LetsAppearanceDecideWhereGeometryCannot) {
    const auto result = CSaliencyAssociation().associate(between(-1, 3));
    EXPECT_EQ(result.decisions[0].landmark, 1);
    EXPECT_EQ(result.decisions[0].logRatio, 3);
    EXPECT_EQ(result.decisions[0].candidates, 2u);
    EXPECT_EQ(CSaliencyAssociation().associate(between(5, -5)).decisions[0].landmark, 0);
}

TEST(CSaliencyAssociation, DefersWhatIsAmbiguous) {
    for (const auto& ratios : {std::pair(3.0, 3.0), std::pair(3.0, 0.1), std::pair(0.0, 0.0)}) {
        const auto result = CSaliencyAssociation().associate(between(ratios.first, ratios.second));
        EXPECT_EQ(result.decisions[0].verdict, EVerdict::deferred);
        EXPECT_EQ(result.decisions[0].reason, EReason::ambiguous);
        EXPECT_EQ(result.decisions[0].landmark, -1);
    }
}

TEST(CSaliencyAssociation, DefersAppearanceThatNeitherProvesNorExcludes) {
    const auto result = CSaliencyAssociation().associate(between(-1, -5));
    EXPECT_EQ(result.decisions[0].verdict, EVerdict::deferred);
    EXPECT_EQ(result.decisions[0].reason, EReason::unsureAppearance);
}

TEST(CSaliencyAssociation, MakesANewLandmarkBesideOnesThatLookDifferent) {
    const auto result = CSaliencyAssociation().associate(between(-5, -5));
    EXPECT_EQ(result.decisions[0].verdict, EVerdict::created);
    EXPECT_EQ(result.dropped.appearance, 2u);
}

TEST(CSaliencyAssociation, GoesByGeometryAloneWhereAppearanceCannotTell) {
    auto problem = test::problem({test::poster(2, 0)}, {{2, 0}}, ELandmarkKind::salient);
    EXPECT_EQ(CSaliencyAssociation().associate(problem).decisions[0].landmark, 0);
    problem.logRatio = [](std::size_t, std::size_t) { return std::nan(""); };
    EXPECT_EQ(CSaliencyAssociation().associate(problem).decisions[0].landmark, 0);
}

TEST(CSaliencyAssociation, AsksForTheAppearanceOfEachNearPairOnce) {
    std::map<std::pair<std::size_t, std::size_t>, int> asked;
    auto problem = test::problem({test::poster(2, 0), test::poster(4, 1), test::seen(2, 0)},
                                 {{2, 0}, {4, 1}, {7, 0}}, ELandmarkKind::salient);
    problem.logRatio = [&](std::size_t observation, std::size_t landmark) {
        ++asked[{observation, landmark}];
        return 2.0;
    };
    CSaliencyAssociation().associate(problem);
    const decltype(asked) expected{{{0, 0}, 1}, {{1, 1}, 1}};
    EXPECT_EQ(asked, expected);
}

TEST(CSaliencyAssociation, LetsASurePosterTellWhichCornersAreWhich) {
    // The robot's pose is off by 1 m in range. Corners stand every metre, so by themselves both
    // corners seen are ambiguous; the poster says that all ranges are 1 m longer than predicted.
    std::vector<Eigen::Vector2d> corners;
    for (int i = 2; i < 8; ++i) corners.push_back({i, 0.5});
    auto problem = test::problem({test::seen(4, 0.5, 0.05), test::seen(6, 0.5, 0.05)}, corners);
    TPredictedLandmark landmark;
    landmark.kind = ELandmarkKind::salient;
    landmark.z << 4, -0.5;
    problem.landmarks.push_back(landmark);
    problem.predictionCovariance = Eigen::MatrixXd::Zero(14, 14);
    test::addCommonError(problem, 1, 0.01);
    TAssociationOptions options;
    options.cornerLogDensity = -10;  // leaves the decision to the margin
    const CSaliencyAssociation associator(options);
    const auto without = associator.associate(problem);
    EXPECT_EQ(without.decisions[0].reason, EReason::ambiguous);
    EXPECT_EQ(without.decisions[1].reason, EReason::ambiguous);

    problem.measurements.push_back(test::poster(5, -0.5, 0.05));
    problem.logRatio = [](std::size_t, std::size_t) { return 3.0; };
    const auto with = associator.associate(problem);
    EXPECT_EQ(with.decisions[2].landmark, 6);
    EXPECT_EQ(with.decisions[0].landmark, 1);  // predicted at 3 m
    EXPECT_EQ(with.decisions[1].landmark, 3);  // predicted at 5 m
}

TEST(CSaliencyAssociation, DefersALoneCandidateThatAnUnknownLandmarkExplainsAsWell) {
    // S of 3 m and 1 rad: log N(0) = -log(2 pi 3) = -2.9, below 4.
    auto problem = test::problem({test::seen(5, 0)}, {{5, 0}});
    test::addCommonError(problem, 3, 1);
    const auto result = CSaliencyAssociation().associate(problem);
    EXPECT_EQ(result.decisions[0].verdict, EVerdict::deferred);
    EXPECT_EQ(result.decisions[0].reason, EReason::improbable);
}

TEST(CSaliencyAssociation, DefersTwoMeasurementsThatFitOneLandmarkEquallyWell) {
    const auto result = CSaliencyAssociation().associate(
        test::problem({test::seen(1.98, 0, 0.02), test::seen(2.02, 0, 0.02)}, {{2, 0}}));
    for (const TDecision& decision : result.decisions)
        EXPECT_EQ(decision.reason, EReason::ambiguous);
}

}  // namespace
}  // namespace salma::association
