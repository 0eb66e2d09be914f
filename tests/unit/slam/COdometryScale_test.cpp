// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/COdometryScale.h>

#include <cmath>
#include <random>

namespace salma::slam {
namespace {

constexpr double kStep = 0.1;  // [m]

/// Drives straight on; odometry reads `read` metres for each.
void drive(double metres, double read, bool known, COdometryScale& scale, double slip = 0) {
    TStepMotion step;
    step.motion = {kStep, 0, 0};
    step.isKnown = known;
    step.slip = {slip, 0, 0};
    for (int i = 0; i < std::lround(metres / kStep); ++i) scale.learn({read * kStep, 0, 0}, step);
}

TEST(COdometryScale, LearnsHowLongAMetreIs) {
    COdometryScale scale;
    EXPECT_EQ(scale.corrected({0.3, -0.1, 0.2}).x(), 0.3);
    drive(60, 1 / 1.06, true, scale);
    EXPECT_NEAR(scale.excess(), 0.06, 0.01);
    const auto corrected = scale.corrected({1 / 1.06, 0, 0.2});
    EXPECT_NEAR(corrected.x(), 1, 0.01);
    EXPECT_NEAR(corrected.phi(), 0.2, 1e-12);
}

TEST(COdometryScale, IsAsSureAsItsStretchesAre) {
    TOdometryOptions options;
    options.scaleSigma = 0.05;
    options.alongPerMetre = 0.1;
    COdometryScale scale(options);
    drive(16.05, 1, true, scale);  // the first step opens the first of 16 stretches of 1 m
    EXPECT_NEAR(1 / std::pow(scale.sigma(), 2), 1 / std::pow(0.05, 2) + 16 / std::pow(0.1, 2), 101);
    EXPECT_LT(scale.sigma(), 0.025);
}

TEST(COdometryScale, AgreesWithNoise) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 0.1 * std::sqrt(kStep));
    COdometryScale scale;
    TStepMotion step;
    step.motion = {kStep, 0, 0};
    step.isKnown = true;
    for (int i = 0; i < 1000; ++i) scale.learn({kStep / 0.95 + noise(random), 0, 0}, step);
    EXPECT_NEAR(scale.excess(), -0.05, 3 * scale.sigma());
}

TEST(COdometryScale, LearnsNothingWhereLandmarksDoNotTellTheWay) {
    COdometryScale scale;
    drive(60, 1.06, false, scale);
    EXPECT_EQ(scale.excess(), 0);
    // Landmarks at either end of a gap: odometry is all that the filter had in between.
    for (int i = 0; i < 20; ++i) {
        drive(kStep, 1.06, true, scale);
        drive(2, 1.06, false, scale);
    }
    EXPECT_EQ(scale.excess(), 0);
}

TEST(COdometryScale, LeavesStretchesWithASlipOut) {
    COdometryScale scale;
    for (int i = 0; i < 30; ++i) {
        drive(0.5, 1.06, true, scale);
        drive(kStep, 1.06, true, scale, 0.4);
    }
    EXPECT_EQ(scale.excess(), 0);
    drive(10, 2, true, scale);  // no scale is so wrong: something else is
    EXPECT_EQ(scale.excess(), 0);
}

TEST(COdometryScale, IsOffOnDemand) {
    TOdometryOptions options;
    options.scaleSigma = 0;
    COdometryScale scale(options);
    drive(60, 1.06, true, scale);
    EXPECT_EQ(scale.excess(), 0);
    EXPECT_EQ(scale.sigma(), 0);
}

}  // namespace
}  // namespace salma::slam
