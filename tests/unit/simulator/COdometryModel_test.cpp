// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/poses/CPose2D.h>
#include <salma/simulator/COdometryModel.h>
#include <salma/simulator/CPath.h>

#include <cmath>

namespace salma::simulator {
namespace {

using mrpt::math::TPose2D;
using mrpt::poses::CPose2D;

/// The path of the shipped hallway, 60 m round.
TPathOptions hallway() {
    TPathOptions options;
    options.points = {0, 0, 12, 0, 12, 12, -6, 12, -6, 0};
    options.laps = 1;
    return options;
}

/// Distance between where the odometry says the lap ended and where it did [m].
double missAfterOneLap(const TOdometryOptions& options, std::uint32_t seed) {
    const CPath path(hallway(), seed);
    COdometryModel odometry(options, seed);
    TPose2D measured, truth;
    for (double t = 0; t < path.duration(); t += 1 / options.rate)
        measured = odometry.next(truth = path.pose(t));
    const CPose2D moved = CPose2D(truth) - CPose2D(path.pose(0));
    return std::hypot(moved.x() - measured.x, moved.y() - measured.y);
}

/// Root mean square of the miss over 400 runs [m].
double sigmaAfterOneLap(EOdometryNoise level) {
    TOdometryOptions options;
    options.level = level;
    constexpr std::uint32_t runs = 400;
    double sum = 0;
    for (std::uint32_t seed = 1; seed <= runs; ++seed) {
        const double miss = missAfterOneLap(options, seed);
        sum += miss * miss;
    }
    return std::sqrt(sum / runs);
}

TEST(COdometryModel, WithoutNoiseItIsTheTrueMotion) {
    TOdometryOptions options;
    options.scaleSigma = options.turnScaleSigma = options.driftSigma = 0;
    options.distanceSigma = options.headingSigma = options.turnSigma = 0;
    EXPECT_NEAR(missAfterOneLap(options, 1), 0, 1e-9);
}

TEST(COdometryModel, StartsAtItsOwnOrigin) {
    COdometryModel odometry({}, 1);
    EXPECT_EQ(odometry.next({3, 4, 1}), TPose2D(0, 0, 0));
}

// Doors are 2.5 m apart. The error of a root mean square of 400 runs is about 5 %.
TEST(COdometryModel, AtMediumTheSigmaAfterOneLapEqualsTheDoorSpacing) {
    EXPECT_NEAR(sigmaAfterOneLap(EOdometryNoise::medium), 2.5, 0.3);
}

TEST(COdometryModel, AtLowItIsBelowTheDoorSpacingAndAtHighFourTimesIt) {
    EXPECT_LT(sigmaAfterOneLap(EOdometryNoise::low), 1.25);
    EXPECT_NEAR(sigmaAfterOneLap(EOdometryNoise::high), 10, 1.2);
}

}  // namespace
}  // namespace salma::simulator
