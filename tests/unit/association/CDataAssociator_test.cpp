// SPDX-License-Identifier: BSD-3-Clause
// What holds for every method.
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "problems.h"

namespace salma::association {
namespace {

class CDataAssociatorTest : public ::testing::TestWithParam<EMethod> {
 protected:
    TAssociation associate(const TAssociationProblem& problem) const {
        TAssociationOptions options;
        options.method = GetParam();
        options.cornerLogDensity = options.salientLogDensity =
            -10;  // leaves the decision to the gates
        return createAssociator(options)->associate(problem);
    }
};

TEST_P(CDataAssociatorTest, MakesEveryMeasurementNewInAnEmptyMap) {
    const auto result = associate(test::problem({test::seen(1, 0), test::seen(2, 1)}, {}));
    ASSERT_EQ(result.decisions.size(), 2u);
    for (const TDecision& decision : result.decisions) {
        EXPECT_EQ(decision.verdict, EVerdict::created);
        EXPECT_EQ(decision.reason, EReason::unexplained);
        EXPECT_EQ(decision.landmark, -1);
    }
}

TEST_P(CDataAssociatorTest, DecidesNothingWithoutMeasurements) {
    const auto result = associate(test::problem({}, {{1, 0}}));
    EXPECT_TRUE(result.decisions.empty());
    EXPECT_TRUE(result.candidates.empty());
}

TEST_P(CDataAssociatorTest, PairsAMeasurementWithTheLandmarkNearIt) {
    // S = 0.01 I, nu = (0.1, 0).
    const auto result = associate(test::problem({test::seen(2.1, 0)}, {{5, 1}, {2, 0}}));
    EXPECT_EQ(result.decisions[0].verdict, EVerdict::paired);
    EXPECT_EQ(result.decisions[0].landmark, 1);
    EXPECT_NEAR(result.decisions[0].distance2, 1, 1e-9);
    EXPECT_EQ(result.decisions[0].candidates, 1u);
    EXPECT_NEAR(result.jointDistance2, 1, 1e-9);
    EXPECT_EQ(result.dropped.distance, 1u);
    ASSERT_EQ(result.candidates.size(), 1u);
    EXPECT_EQ(result.candidates[0].landmark, 1u);
    EXPECT_TRUE(result.candidates[0].chosen);
}

TEST_P(CDataAssociatorTest, PairsAcrossTheHalfTurn) {
    const auto result = associate(test::problem({test::seen(2, M_PI - 0.05)}, {{2, -M_PI + 0.05}}));
    EXPECT_EQ(result.decisions[0].landmark, 0);
    EXPECT_NEAR(result.decisions[0].distance2, 1, 1e-9);
}

TEST_P(CDataAssociatorTest, DefersBetweenTheGateAndTheDistanceOfANewLandmark) {
    // Gate 3.035 sigma, new landmarks from sqrt(30) = 5.477 sigma on; sigma = 0.1 m.
    const auto verdict = [this](double range) {
        return associate(test::problem({test::seen(range, 0)}, {{2, 0}})).decisions[0].verdict;
    };
    EXPECT_EQ(verdict(2.303), EVerdict::paired);
    EXPECT_EQ(verdict(2.304), EVerdict::deferred);
    EXPECT_EQ(verdict(2.547), EVerdict::deferred);
    EXPECT_EQ(verdict(2.548), EVerdict::created);
}

TEST_P(CDataAssociatorTest, ListsEachLandmarkThatIsNearWithItsDistance) {
    // Innovations 0.1, 0.4 and 0.7 m with sigma = 0.1 m: in the gate, near, far.
    const auto result =
        associate(test::problem({test::seen(2, 0)}, {{2.7, 0}, {2.1, 0}, {1.6, 0}}));
    ASSERT_EQ(result.candidates.size(), 2u);
    EXPECT_EQ(result.candidates[0].landmark, 1u);
    EXPECT_NEAR(result.candidates[0].distance2, 1, 1e-9);
    EXPECT_TRUE(result.candidates[0].inGate);
    EXPECT_EQ(result.candidates[1].landmark, 2u);
    EXPECT_NEAR(result.candidates[1].distance2, 16, 1e-9);
    EXPECT_FALSE(result.candidates[1].inGate);
    EXPECT_FALSE(result.candidates[1].chosen);
    EXPECT_TRUE(std::isnan(result.candidates[0].logRatio));
    EXPECT_EQ(result.decisions[0].candidates, 1u);
}

TEST_P(CDataAssociatorTest, NeverPairsALandmarkTwice) {
    const auto result =
        associate(test::problem({test::seen(2.25, 0), test::seen(2.01, 0)}, {{2, 0}}));
    EXPECT_NE(result.decisions[0].verdict, EVerdict::paired);
    EXPECT_NE(result.decisions[0].verdict, EVerdict::created);
}

TEST_P(CDataAssociatorTest, KeepsKindsAndConvexityApart) {
    auto problem = test::problem({test::poster(2, 0), test::seen(2, 0)}, {{2, 0}});
    problem.landmarks[0].convex = true;
    const auto result = associate(problem);
    EXPECT_EQ(result.decisions[0].verdict, EVerdict::created);
    EXPECT_EQ(result.decisions[1].verdict, EVerdict::created);
    EXPECT_EQ(result.dropped.kind, 2u);
}

TEST_P(CDataAssociatorTest, ComparesTheAnglesOfTheWalls) {
    // Sigma of the difference = hypot(0.06, 0.08) = 0.1; 99 % of one degree of freedom:
    // 2.5758.
    auto problem = test::problem({test::poster(2, 0)}, {{2, 0}}, ELandmarkKind::salient);
    problem.measurements[0].wallAngle = M_PI;
    problem.measurements[0].wallAngleSigma = 0.06;
    problem.landmarks[0].wallAngleSigma = 0.08;
    problem.landmarks[0].wallAngle = -M_PI + 0.2575;
    EXPECT_EQ(associate(problem).decisions[0].verdict, EVerdict::paired);
    problem.landmarks[0].wallAngle = -M_PI + 0.2577;
    const auto turned = associate(problem);
    EXPECT_EQ(turned.decisions[0].verdict, EVerdict::created);
    EXPECT_EQ(turned.dropped.wallAngle, 1u);
}

TEST_P(CDataAssociatorTest, LeavesOutWhatIsNotVisible) {
    auto problem = test::problem({test::seen(2, 0)}, {{2, 0}});
    problem.landmarks[0].visible = false;
    const auto result = associate(problem);
    EXPECT_EQ(result.decisions[0].verdict, EVerdict::created);
    EXPECT_EQ(result.dropped.invisible, 1u);
}

TEST_P(CDataAssociatorTest, HonoursIdentitiesBesideMeasurementsWithoutOne) {
    // The known one lies far from its landmark, and nearer to the other one.
    auto problem =
        test::problem({test::seen(3, 0), test::seen(3.1, 0), test::seen(5, 1)}, {{2, 0}, {3, 0}});
    problem.landmarks[0].identity = 10;
    problem.measurements[0].identity = 10;
    problem.measurements[2].identity = 11;
    const auto result = associate(problem);
    EXPECT_EQ(result.decisions[0].landmark, 0);
    EXPECT_EQ(result.decisions[0].reason, EReason::identity);
    EXPECT_EQ(result.decisions[1].landmark, 1);
    EXPECT_EQ(result.decisions[2].verdict, EVerdict::created);
    EXPECT_EQ(result.decisions[2].reason, EReason::identity);
}

TEST_P(CDataAssociatorTest, GivesAnUnknownLandmarkTheIdentityThatComesLater) {
    auto problem = test::problem({test::seen(2, 0)}, {{2, 0}});
    problem.measurements[0].identity = 7;
    EXPECT_EQ(associate(problem).decisions[0].landmark, 0);
    problem.landmarks[0].identity = 8;
    EXPECT_EQ(associate(problem).decisions[0].verdict, EVerdict::created);
}

TEST_P(CDataAssociatorTest, RefusesASecondMeasurementOfOneIdentity) {
    auto problem = test::problem({test::seen(2, 0), test::seen(2, 0)}, {{2, 0}});
    problem.landmarks[0].identity = 1;
    for (auto& measurement : problem.measurements) measurement.identity = 1;
    const auto result = associate(problem);
    EXPECT_EQ(result.decisions[0].landmark, 0);
    EXPECT_EQ(result.decisions[1].verdict, EVerdict::clutter);
    EXPECT_EQ(result.decisions[1].reason, EReason::repeatedIdentity);
}

TEST_P(CDataAssociatorTest, TakesForClutterWhatIsNotSound) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    auto problem = test::problem(
        {test::seen(nan, 0), test::seen(2, nan), test::seen(-1, 0), test::seen(2, 0)}, {{2, 0}});
    problem.measurements[3].R << 1, 2, 2, 1;
    const auto result = associate(problem);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(result.decisions[i].verdict, EVerdict::clutter);
        EXPECT_EQ(result.decisions[i].reason, EReason::notFinite);
    }
    EXPECT_EQ(result.decisions[3].verdict, EVerdict::clutter);
    EXPECT_EQ(result.decisions[3].reason, EReason::badCovariance);
}

TEST_P(CDataAssociatorTest, CountsALandmarkWithoutUsableCovariance) {
    auto problem = test::problem({test::seen(2, 0)}, {{2, 0}});
    problem.predictionCovariance(0, 0) = -1;
    const auto result = associate(problem);
    EXPECT_EQ(result.dropped.singular, 1u);
    EXPECT_NE(result.decisions[0].verdict, EVerdict::paired);
}

TEST_P(CDataAssociatorTest, RefusesACovarianceOfTheWrongSizeOrNotFinite) {
    auto problem = test::problem({test::seen(2, 0)}, {{2, 0}});
    problem.predictionCovariance(0, 1) = std::numeric_limits<double>::infinity();
    EXPECT_THROW(associate(problem), std::invalid_argument);
    problem.predictionCovariance = Eigen::MatrixXd::Zero(4, 4);
    EXPECT_THROW(associate(problem), std::invalid_argument);
}

TEST_P(CDataAssociatorTest, TakesForClutterWhatStatesNoCovariance) {
    auto problem = test::problem({test::seen(2, 0)}, {{2, 0}});
    problem.measurements[0].R.setZero();
    EXPECT_EQ(associate(problem).decisions[0].reason, EReason::badCovariance);
    problem.measurements[0].R.setConstant(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(associate(problem).decisions[0].reason, EReason::notFinite);
}

TEST_P(CDataAssociatorTest, RefusesAPredictionThatIsNotFinite) {
    auto problem = test::problem({test::seen(2, 0)}, {{2, 0}});
    problem.landmarks[0].z[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(associate(problem), std::invalid_argument);
}

TEST_P(CDataAssociatorTest, LooksAtTheNearestOfThousandsOfMeasurementsAndCountsTheOthers) {
    // Every fifth measurement shows a landmark, 400 landmarks in all; the rest is noise.
    std::mt19937 random(4);
    std::uniform_real_distribution<double> range(1, 20);
    std::uniform_real_distribution<double> bearing(-M_PI, M_PI);
    std::vector<Eigen::Vector2d> landmarks;
    std::vector<TMeasurement> measurements;
    for (int i = 0; i < 5000; ++i) {
        const Eigen::Vector2d z(range(random), bearing(random));
        if (i % 5 == 0 && landmarks.size() < 400) landmarks.push_back(z);
        measurements.push_back(test::seen(z[0], z[1], 0.02));
    }
    auto problem = test::problem(measurements, landmarks);
    test::addCommonError(problem, 0.1, 0.05);
    const auto result = associate(problem);
    ASSERT_EQ(result.decisions.size(), 5000u);
    std::size_t refused = 0;
    double farthest = 0, nearestRefused = 20;
    for (std::size_t i = 0; i < 5000; ++i) {
        const bool tooMany = result.decisions[i].reason == EReason::tooMany;
        refused += tooMany;
        double& edge = tooMany ? nearestRefused : farthest;
        edge =
            tooMany ? std::min(edge, measurements[i].z[0]) : std::max(edge, measurements[i].z[0]);
        if (tooMany) {
            EXPECT_EQ(result.decisions[i].verdict, EVerdict::deferred);
        }
    }
    EXPECT_EQ(refused, 4800u);
    EXPECT_LE(farthest, nearestRefused);
    EXPECT_TRUE(std::isfinite(result.jointDistance2));
}

TEST_P(CDataAssociatorTest, SumsUpItsPairings) {
    std::mt19937 random(5);
    const auto result = associate(test::randomProblem(random));
    const auto isPaired = [](const TDecision& d) { return d.verdict == EVerdict::paired; };
    EXPECT_EQ(result.pairings, static_cast<std::size_t>(std::count_if(
                                   result.decisions.begin(), result.decisions.end(), isPaired)));
    EXPECT_TRUE(result.search.complete);
}

TEST_P(CDataAssociatorTest, DoesNotDependOnTheOrderOfMeasurementsAndLandmarks) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 50; ++trial) {
        const auto problem = test::randomProblem(random);
        std::vector<std::size_t> rows(problem.measurements.size());
        std::vector<std::size_t> columns(problem.landmarks.size());
        std::iota(rows.begin(), rows.end(), 0);
        std::iota(columns.begin(), columns.end(), 0);
        std::shuffle(rows.begin(), rows.end(), random);
        std::shuffle(columns.begin(), columns.end(), random);
        auto shuffled = problem;
        for (std::size_t i = 0; i < rows.size(); ++i)
            shuffled.measurements[i] = problem.measurements[rows[i]];
        for (std::size_t a = 0; a < columns.size(); ++a) {
            shuffled.landmarks[a] = problem.landmarks[columns[a]];
            for (std::size_t b = 0; b < columns.size(); ++b)
                shuffled.predictionCovariance.block<2, 2>(2 * a, 2 * b) =
                    problem.predictionCovariance.block<2, 2>(2 * columns[a], 2 * columns[b]);
        }
        const auto expected = associate(problem);
        const auto result = associate(shuffled);
        EXPECT_NEAR(result.jointDistance2, expected.jointDistance2, 1e-9);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const TDecision& before = expected.decisions[rows[i]];
            const TDecision& after = result.decisions[i];
            EXPECT_EQ(after.verdict, before.verdict);
            ASSERT_EQ(after.landmark < 0 ? -1 : static_cast<int>(columns[after.landmark]),
                      before.landmark);
        }
    }
}

TEST_P(CDataAssociatorTest, PairsOneToOneAndMarksTheChosenCandidates) {
    std::mt19937 random(3);
    std::size_t paired = 0;
    for (int trial = 0; trial < 50; ++trial) {
        const auto result = associate(test::randomProblem(random));
        std::set<int> used;
        std::size_t chosen = 0;
        for (const TDecision& decision : result.decisions) {
            if (decision.verdict != EVerdict::paired) continue;
            ++paired;
            EXPECT_TRUE(used.insert(decision.landmark).second);
            EXPECT_LE(decision.distance2, 9.2104);
        }
        for (const TCandidate& candidate : result.candidates) chosen += candidate.chosen;
        EXPECT_EQ(chosen, used.size());
    }
    EXPECT_GT(paired, 200u);  // of 400 that are there
}

std::string nameOf(const ::testing::TestParamInfo<EMethod>& method) {
    return std::vector<std::string>{"nn", "scnn", "jcbb",
                                    "saliency"}[static_cast<int>(method.param)];
}

INSTANTIATE_TEST_SUITE_P(
    Methods,
    CDataAssociatorTest,
    ::testing::Values(EMethod::nn, EMethod::scnn, EMethod::jcbb, EMethod::saliency),
    nameOf);

TEST(TAssociationOptions, RefusesAMethodThatDoesNotExist) {
    const mrpt::config::CConfigFileMemory file(std::string("[association]\nmethod = icp\n"));
    TAssociationOptions options;
    EXPECT_THROW(options.loadFromConfigFile(file, "association"), std::invalid_argument);
    EXPECT_EQ(options.method, EMethod::saliency);
}

TEST(TAssociationOptions, RefusesASearchWithoutTests) {
    TAssociationOptions options;
    options.searchLimit = 0;
    EXPECT_THROW(createAssociator(options), std::invalid_argument);
}

TEST(TAssociationOptions, RefusesThresholdsInTheWrongOrder) {
    TAssociationOptions options;
    options.forbidLogLr = options.acceptLogLr;
    EXPECT_THROW(createAssociator(options), std::invalid_argument);
}

}  // namespace
}  // namespace salma::association
