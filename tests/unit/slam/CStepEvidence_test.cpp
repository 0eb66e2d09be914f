// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/CSalientEKF2D.h>
#include <salma/slam/CStepEvidence.h>

#include <cmath>

namespace salma::slam {
namespace {

constexpr double kDegree = M_PI / 180;

/// A poster 3 m ahead whose normal is turned from the robot by `angle`; `mark` is what it shows.
association::TMeasurement poster(double mark, double angle = 0, double bearing = 0) {
    association::TMeasurement m;
    m.kind = association::ELandmarkKind::salient;
    m.z << 3, bearing;
    m.R = Eigen::Vector2d(0.05 * 0.05, 0.01 * 0.01).asDiagonal();
    m.wallAngle = bearing + M_PI - angle;
    m.wallAngleSigma = 0.03;
    auto patch = std::make_shared<observations::TPatch>();
    patch->width = mark;
    m.patch = patch;
    return m;
}

/// Same mark: log ratio 3.9, as duplicate_rate = 0.02 allows; else -3.
double ratioOf(const observations::TPatch& a, const observations::TPatch& b) {
    return a.width == b.width ? 3.9 : -3;
}

/// A table of posters, and one measurement against predictions of all of them, straight ahead.
struct TScene {
    explicit TScene(const std::vector<double>& marks) {
        for (const double mark : marks) {
            const auto m = poster(mark);
            const auto index = table.size();
            table.add(m, 0);
            if (table.sight(index, m, 0, {})) table.findLookAlikes(index, ratio);
        }
    }
    /// \param where Bearing at which each landmark is predicted; all ahead if empty.
    CStepEvidence evidence(const association::TMeasurement& seen,
                           double time,
                           const std::vector<double>& where = {}) const {
        association::TAssociationProblem problem;
        problem.measurements = {seen};
        for (std::size_t j = 0; j < table.size(); ++j) {
            association::TPredictedLandmark expected;
            expected.kind = association::ELandmarkKind::salient;
            expected.z << 3, where.empty() ? 0 : where[j];
            problem.landmarks.push_back(expected);
        }
        const auto size = static_cast<Eigen::Index>(2 * table.size());
        problem.predictionCovariance = 1e-6 * Eigen::MatrixXd::Identity(size, size);
        return CStepEvidence(limits, table, ratio, problem, time);
    }
    /// What counts for landmark 0; then the landmark is paired.
    double pairing(double mark, double angle, double time) {
        const auto seen = poster(mark, angle);
        CStepEvidence now = evidence(seen, time);
        const double result = now.logRatio(0, 0);
        const bool counts = now.counts(0, 0);
        table.sight(0, seen, time, {});
        if (counts) table.setCounted(0, viewingAngle(seen));
        return result;
    }
    TEvidenceLimits limits{30 * kDegree, 10, -2, 0.99};
    PatchRatio ratio = ratioOf;
    CLandmarkTable table{4, 15 * kDegree};
};

TEST(CStepEvidence, CountsAppearanceOnceInATrackAndAgainFromAnotherAngle) {
    TScene scene({1});
    EXPECT_EQ(scene.pairing(1, -40 * kDegree, 1), 3.9) << "the first pairing";
    for (int degrees = -38; degrees < -10; degrees += 4)
        EXPECT_EQ(scene.pairing(1, degrees * kDegree, 2), 0) << degrees;
    EXPECT_EQ(scene.pairing(1, -10 * kDegree, 3), 3.9) << "30 deg on";
    EXPECT_EQ(scene.pairing(1, 19 * kDegree, 4), 0);
    EXPECT_EQ(scene.pairing(1, 21 * kDegree, 5), 3.9);
    EXPECT_EQ(scene.pairing(1, 20 * kDegree, 15), 0) << "10 s without it: the same track";
    EXPECT_EQ(scene.pairing(1, 20 * kDegree, 25.1), 3.9) << "the next lap";
    // Of 12 sightings in one pass four counted: their ratios add up to 4 x 3.9, not to 12 x 3.9.
}

TEST(CStepEvidence, CountsEveryViewIfAllAnglesAreIndependent) {
    TScene scene({1});
    scene.limits.decorrelation = 0;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(scene.pairing(1, 0, i), 3.9);
}

TEST(CStepEvidence, StillForbidsWhatLooksOtherwiseInTheMiddleOfATrack) {
    TScene scene({1});
    scene.pairing(1, 0, 1);
    EXPECT_EQ(scene.pairing(2, 0, 2), -3) << "another poster hangs there now";
    scene.limits.forbid = -4;  // the same ratio as mere doubt
    EXPECT_EQ(scene.pairing(2, 0, 3), 0) << "geometry alone counts";
}

TEST(CStepEvidence, DoesNotHandATrackToALookAlikeBesideIt) {
    TScene scene({1, 1, 2});
    const double alone = scene.evidence(poster(1), 0.5).logRatio(0, 1);
    EXPECT_GT(alone, 0.5) << "before any track, both count alike";
    scene.pairing(1, 0, 1);
    CStepEvidence now = scene.evidence(poster(1), 2);
    EXPECT_EQ(now.logRatio(0, 0), 0);
    EXPECT_EQ(now.logRatio(0, 1), 0) << "no lead over the landmark of the track";
    EXPECT_EQ(now.logRatio(0, 2), -3) << "what speaks against a rival stays";
    EXPECT_FALSE(now.counts(0, 0));
    EXPECT_TRUE(now.counts(0, 1));
}

TEST(CStepEvidence, GoesOnWithATrackOnlyInsideItsGate) {
    TScene scene({1, 1});
    scene.pairing(1, 0, 1);
    // Landmark 0 is predicted 6 sigma to the side, landmark 1 ahead.
    CStepEvidence now = scene.evidence(poster(1), 2, {0.06, 0});
    EXPECT_GT(now.logRatio(0, 1), 0.5) << "not the poster of the track: its look counts";
}

TEST(CStepEvidence, SaysNothingWithoutAPatch) {
    TScene scene({1});
    association::TMeasurement blind = poster(1);
    blind.patch.reset();
    CStepEvidence now = scene.evidence(blind, 1);
    EXPECT_TRUE(std::isnan(now.logRatio(0, 0)));
    EXPECT_FALSE(now.counts(0, 0));
}

TEST(CStepEvidence, BoundsTheRatioByTheShareOfLookAlikesInTheMap) {
    const auto ratio = [](const std::vector<double>& marks) {
        const TScene scene(marks);
        return std::exp(scene.evidence(poster(1), 1).logRatio(0, 0));
    };
    const double none = ratio({1, 2, 3, 4, 5});
    const double one = ratio({1, 1, 3, 4, 5}), two = ratio({1, 1, 1, 4, 5});
    const double all = ratio({1, 1, 1, 1, 1});
    EXPECT_NEAR(none, std::exp(3.9), 1e-9);
    // LR / (1 - q + q LR) with q = 1/5, 2/5, 4/5
    EXPECT_NEAR(one, std::exp(3.9) / (0.8 + 0.2 * std::exp(3.9)), 1e-9);
    EXPECT_LT(one, 5);
    EXPECT_LT(two, 2.5);
    EXPECT_LT(all, 1.25);
    EXPECT_GT(all, 1);
    EXPECT_GT(one, two);
    EXPECT_GT(two, all);
    const TScene scene({1, 1, 1});
    EXPECT_EQ(scene.evidence(poster(2), 1).logRatio(0, 0), -3) << "what excludes, excludes";
}

TEST(CStepEvidence, GivesWithTheMatchersOwnRateTheMixtureOfBoth) {
    // p(score|other) holds a share pi of duplicates, of the rest a share q of look-alikes.
    const double r = 300, pi = 0.02, q = 0.2;
    const double matcher = r / (1 - pi + pi * r);
    TScene scene({1, 1, 3, 4, 5});
    scene.ratio = [&](const observations::TPatch& a, const observations::TPatch& b) {
        return a.width == b.width ? std::log(matcher) : -3;
    };
    const double both = 1 - (1 - pi) * (1 - q);
    EXPECT_NEAR(std::exp(scene.evidence(poster(1), 1).logRatio(0, 0)), r / (1 - both + both * r),
                1e-9);
}

TEST(CLandmarkTable, KnowsWhichLandmarksLookAlike) {
    const TScene scene({1, 2, 1, 1});
    EXPECT_EQ(scene.table[0].lookAlikes, (std::set<int>{2, 3}));
    EXPECT_TRUE(scene.table[1].lookAlikes.empty());
    EXPECT_EQ(scene.table[3].lookAlikes, (std::set<int>{0, 2}));
    EXPECT_EQ(scene.table.lookAlikeShare(0), 0.5);
    EXPECT_EQ(scene.table.lookAlikeShare(1), 0);
}

/// Log ratios that a filter's pairings were judged by, for one poster seen from many steps.
std::vector<double> ratiosOf(const TEkfOptions& options, int steps) {
    CSalientEKF2D filter(options, {}, ratioOf);
    for (int i = 0; i < steps; ++i) {
        TStepInput input;
        input.time = i;
        input.increment.cov.setDiagonal(std::vector<double>{1e-6, 1e-6, 1e-6});
        input.measurements = {poster(1)};
        filter.process(input);
    }
    TRunRecord record;
    filter.results(record);
    std::vector<double> ratios;
    for (const auto& row : record.associations)
        if (row.decision == EDecision::paired) ratios.push_back(row.logRatio);
    return ratios;
}

TEST(CSalientEKF2D, CountsTheAppearanceOfAStandingRobotOnce) {
    TEkfOptions options;
    const auto ratios = ratiosOf(options, 6);
    EXPECT_EQ(ratios, (std::vector<double>{3.9, 0, 0, 0, 0})) << "all five are paired";
    options.decorrelation = 0;
    EXPECT_EQ(ratiosOf(options, 6), (std::vector<double>{3.9, 3.9, 3.9, 3.9, 3.9}));
}

}  // namespace
}  // namespace salma::slam
