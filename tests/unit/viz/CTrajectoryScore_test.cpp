// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/viz/CTrajectoryScore.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace salma::viz {
namespace {

using mrpt::poses::CPose2D;

/// An L of 1 m steps, one a second: five poses east, then four north.
TTrajectory corner() {
    TTrajectory path;
    for (int i = 0; i < 5; ++i) path.push_back({100.0 + i, CPose2D(i, 0, 0)});
    for (int i = 1; i < 5; ++i) path.push_back({104.0 + i, CPose2D(4, i, M_PI / 2)});
    return path;
}

TTrajectory moved(const CPose2D& by, TTrajectory path) {
    for (auto& row : path) row.T_w_r = by + row.T_w_r;
    return path;
}

TEST(CTrajectoryScore, SeesNoErrorAfterAlignmentInAMovedAndTurnedCopy) {
    const CPose2D by(3, -2, 2.5);
    const auto f = CTrajectoryScore().compare(corner(), moved(by, corner()));
    EXPECT_EQ(f.pairs, 9U);
    EXPECT_EQ(f.unmatched, 0U);
    EXPECT_NEAR(f.aligned.rmse, 0, 1e-12);
    EXPECT_NEAR(f.alignedHeading.max, 0, 1e-12);
    EXPECT_NEAR(f.perMetres.translation.max, 0, 1e-12);
    EXPECT_NEAR(f.perTime.rotation.max, 0, 1e-12);
    EXPECT_NEAR((f.T_ref_est + by).norm(), 0, 1e-12);
    EXPECT_NEAR((f.T_ref_est + by).phi(), 0, 1e-12);
}

TEST(CTrajectoryScore, MeasuresAShiftWithoutAlignmentExactly) {
    const auto f = CTrajectoryScore().compare(corner(), moved(CPose2D(3, 4, 0), corner()));
    EXPECT_NEAR(f.unaligned.rmse, 5, 1e-12);
    EXPECT_NEAR(f.unaligned.mean, 5, 1e-12);
    EXPECT_NEAR(f.unaligned.max, 5, 1e-12);
    EXPECT_NEAR(f.aligned.max, 0, 1e-12);
}

TEST(CTrajectoryScore, SplitsAnErrorOnAStraightLineAsOneDoesByHand) {
    // Four poses on a line, the estimate pushed by +-0.1 m across: the best fit leaves them there,
    // turned by atan(0) because the pushes + - - + have no slope.
    TTrajectory reference, estimate;
    const double push[] = {0.1, -0.1, -0.1, 0.1};
    for (int i = 0; i < 4; ++i) {
        reference.push_back({double(i), CPose2D(i, 0, 0)});
        estimate.push_back({double(i), CPose2D(i, push[i], 0)});
    }
    const auto f = CTrajectoryScore().compare(reference, estimate);
    EXPECT_NEAR(f.aligned.rmse, 0.1, 1e-12);
    EXPECT_NEAR(f.T_ref_est.phi(), 0, 1e-12);
    // Relative errors over 1 m: 0.2, 0, 0.2.
    EXPECT_EQ(f.perMetres.translation.count, 3U);
    EXPECT_NEAR(f.perMetres.translation.mean, 0.4 / 3, 1e-12);
    EXPECT_NEAR(f.perMetres.translation.rmse, std::sqrt(0.08 / 3), 1e-12);
    EXPECT_NEAR(f.perMetres.translation.max, 0.2, 1e-12);
}

TEST(CTrajectoryScore, MeasuresTheDriftOfAnOdometryThatIsTwoPercentTooLong) {
    TTrajectory estimate = corner();
    for (auto& row : estimate)
        row.T_w_r = CPose2D(1.02 * row.T_w_r.x(), 1.02 * row.T_w_r.y(), row.T_w_r.phi());
    TScoreOptions options;
    options.deltaMetres = 2;
    const auto f = CTrajectoryScore(options).compare(corner(), estimate);
    EXPECT_EQ(f.perMetres.translation.count, 7U);
    EXPECT_NEAR(f.perTime.translation.rmse, 0.02, 1e-12);  // 1 s is 1 m
    // Over 2 m all spans are straight but the one around the corner, which is sqrt(2) m long.
    EXPECT_NEAR(f.perMetres.translation.max, 0.04, 1e-12);
    EXPECT_NEAR(f.perMetres.translation.mean, (6 * 0.04 + 0.02 * std::sqrt(2)) / 7, 1e-12);
    EXPECT_NEAR(f.referenceLength, 8, 1e-12);
}

TEST(CTrajectoryScore, MeasuresAHeadingThatDriftsAcrossTheHalfTurn) {
    TTrajectory reference, estimate;
    for (int i = 0; i < 5; ++i) {
        reference.push_back({double(i), CPose2D(i, 0, M_PI - 0.01)});
        estimate.push_back({double(i), CPose2D(i, 0, M_PI - 0.01 + 0.02 * i)});
    }
    const auto f = CTrajectoryScore().compare(reference, estimate);
    EXPECT_NEAR(f.perTime.rotation.max, 0.02, 1e-9);
    EXPECT_NEAR(f.alignedHeading.max, 0.08, 1e-9);
}

TEST(CTrajectoryScore, InterpolatesTheReferenceAndLeavesOutWhatLiesInAGap) {
    TTrajectory reference{{0, CPose2D(0, 0, 3.1)}, {1, CPose2D(2, 0, -3.1)}, {9, CPose2D(4, 0, 0)}};
    CPose2D pose;
    ASSERT_TRUE(interpolate(reference, 0.5, 1, pose));
    EXPECT_NEAR(pose.x(), 1, 1e-12);
    EXPECT_NEAR(std::abs(pose.phi()), M_PI, 1e-9) << "the short way, not through 0";
    EXPECT_FALSE(interpolate(reference, 0.5, 0.9, pose)) << "gap longer than allowed";
    EXPECT_FALSE(interpolate(reference, 5, 1, pose));
    EXPECT_FALSE(interpolate(reference, -0.1, 1, pose));
    EXPECT_FALSE(interpolate(reference, 9.1, 1, pose));
    EXPECT_TRUE(interpolate(reference, 9, 1, pose)) << "a pose at the very stamp needs no other";
    EXPECT_TRUE(interpolate(reference, 9.0000005, 1, pose));
    TScoreOptions options;
    options.maxGap = 1;
    const TTrajectory estimate{{0, {}}, {0.5, {}}, {5, {}}, {9, {}}, {10, {}}};
    const auto f = CTrajectoryScore(options).compare(reference, estimate);
    EXPECT_EQ(f.pairs, 3U);
    EXPECT_EQ(f.unmatched, 2U);
}

TEST(CTrajectoryScore, DoesNotDependOnTheFrameOfTheEstimate) {
    TTrajectory estimate = corner();
    for (std::size_t i = 0; i < estimate.size(); ++i)
        estimate[i].T_w_r += CPose2D(0.05 * std::sin(3.0 * double(i)), 0.03, 0.01 * double(i % 3));
    const auto a = CTrajectoryScore().compare(corner(), estimate);
    const auto b = CTrajectoryScore().compare(corner(), moved(CPose2D(-7, 5, -2), estimate));
    EXPECT_GT(a.aligned.rmse, 0.01);
    EXPECT_NEAR(a.aligned.rmse, b.aligned.rmse, 1e-12);
    EXPECT_NEAR(a.aligned.max, b.aligned.max, 1e-12);
    EXPECT_NEAR(a.perMetres.translation.rmse, b.perMetres.translation.rmse, 1e-12);
    EXPECT_NEAR(a.perMetres.rotation.rmse, b.perMetres.rotation.rmse, 1e-12);
}

TEST(CTrajectoryScore, FindsNoBetterAlignmentNearby) {
    TTrajectory estimate = corner();
    for (std::size_t i = 0; i < estimate.size(); ++i)
        estimate[i].T_w_r += CPose2D(0.2 * std::sin(5.0 * double(i)), 0.1 * std::cos(double(i)), 0);
    const auto best = CTrajectoryScore().compare(corner(), estimate);
    for (const double dx : {-0.01, 0.0, 0.01})
        for (const double dphi : {-0.01, 0.01}) {
            const auto nearby = moved(CPose2D(dx, -dx, dphi) + best.T_ref_est, estimate);
            EXPECT_GT(CTrajectoryScore().compare(corner(), nearby).unaligned.rmse,
                      best.aligned.rmse);
        }
}

TEST(CTrajectoryScore, RefusesTrajectoriesThatDoNotMeetAndBadOptions) {
    const TTrajectory later{{500, {}}, {501, {}}};
    EXPECT_THROW(CTrajectoryScore().compare(corner(), later), std::invalid_argument);
    TScoreOptions options;
    options.deltaMetres = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(CTrajectoryScore{options}, std::invalid_argument);
    options = {};
    options.maxGap = 0;
    EXPECT_THROW(CTrajectoryScore{options}, std::invalid_argument);
}

}  // namespace
}  // namespace salma::viz
