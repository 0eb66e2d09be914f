// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/laser/CWallOdometry.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <stdexcept>

namespace salma::laser {
namespace {

using mrpt::poses::CPose2D;
using mrpt::poses::CPosePDFGaussian;
using Walls = std::vector<TLine>;

/// The wall between two points, seen from the origin of their frame.
TLine wall(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to, double sigma = 1e-5) {
    TLine line;
    line.from = from;
    line.to = to;
    const mrpt::math::TPoint2D along = (to - from) * (1 / (to - from).norm());
    line.rho = -from.x * along.y + from.y * along.x;
    line.alpha = std::atan2(along.x, -along.y);
    if (line.rho < 0) {
        line.rho = -line.rho;
        line.alpha = std::atan2(-along.x, along.y);
    }
    line.covariance = Eigen::Vector2d(sigma * sigma, sigma * sigma).asDiagonal();
    return line;
}

const TLine kLeft = wall({6, 1}, {-6, 1});
const TLine kRight = wall({-6, -1}, {6, -1});
const TLine kAhead = wall({6, -1}, {6, 1});

/// The walls as the robot sees them from T_w_r; each keeps its covariance.
Walls seen(const Walls& walls, const CPose2D& T_w_r) {
    Walls lines;
    for (const TLine& w : walls) {
        lines.push_back(transformed(w, CPose2D(0, 0, 0) - T_w_r));
        lines.back().covariance = w.covariance;
    }
    return lines;
}

CPosePDFGaussian increment(const CPose2D& mean) {
    CPosePDFGaussian result;
    result.mean = mean;
    result.cov.setDiagonal(std::vector<double>{0.05 * 0.05, 0.04 * 0.04, 0.03 * 0.03});
    return result;
}

/// Walls as flat and straight as these lines are.
TWallOdometryOptions exact() {
    TWallOdometryOptions options;
    options.rhoSigma = options.alphaSigma = 0;
    return options;
}

void expectPose(const CPose2D& pose, double x, double y, double heading, double tolerance) {
    EXPECT_NEAR(pose.x(), x, tolerance);
    EXPECT_NEAR(pose.y(), y, tolerance);
    EXPECT_NEAR(pose.phi(), heading, tolerance);
}

TEST(CWallOdometry, CorrectsTheTurnAndTheMotionSquareToAWallAndBelievesOdometryAlongIt) {
    CWallOdometry walls(exact());
    walls.refine(increment(CPose2D(0, 0, 0)), {kLeft});
    const auto said = increment(CPose2D(0.6, 0.05, 0.03));
    const auto told = walls.refine(said, seen({kLeft}, CPose2D(0.5, 0.1, 0.01)));
    EXPECT_EQ(walls.matched(), 1u);
    EXPECT_NEAR(told.mean.x(), 0.6, 1e-9);  // as odometry says
    EXPECT_NEAR(told.mean.y(), 0.1, 1e-4);
    EXPECT_NEAR(told.mean.phi(), 0.01, 1e-4);
    EXPECT_NEAR(told.cov(0, 0), 0.05 * 0.05, 1e-9);
    EXPECT_LT(told.cov(1, 1), 1e-8);
    EXPECT_LT(told.cov(2, 2), 1e-8);
}

TEST(CWallOdometry, KnowsTheWholeMotionBetweenWallsThatCross) {
    CWallOdometry walls(exact());
    walls.refine(increment(CPose2D(0, 0, 0)), {kLeft, kAhead});
    const auto told = walls.refine(increment(CPose2D(0.56, -0.03, 0.1)),
                                   seen({kLeft, kAhead}, CPose2D(0.5, 0, 0.12)));
    EXPECT_EQ(walls.matched(), 2u);
    expectPose(told.mean, 0.5, 0, 0.12, 1e-4);
}

TEST(CWallOdometry, TellsEachMotionInTheFrameOfTheRobotBeforeIt) {
    CWallOdometry walls(exact());
    CPose2D truth, told;
    const CPose2D step(0.2, 0.02, 0.11), error(0.02, -0.015, 0.01);
    CPosePDFGaussian last;
    for (int i = 0; i < 8; ++i) {  // all in sight of the first reference
        if (i > 0) truth = truth + step;
        const auto said = i > 0 ? increment(step + error) : increment(CPose2D(0, 0, 0));
        last = walls.refine(said, seen({kLeft, kAhead}, truth));
        told = told + last.mean;
    }
    expectPose(told, truth.x(), truth.y(), truth.phi(), 1e-3);
    EXPECT_LT(last.mean.distanceTo(step), 1e-3);
}

TEST(CWallOdometry, ShrinksTheCovarianceInTheAxesOfTheRobot) {
    // A robot that looks at the wall it follows: what the wall tells is its own forward motion.
    CWallOdometry walls(exact());
    const CPose2D aside(0, 0, M_PI / 2);
    walls.refine(increment(CPose2D(0, 0, 0)), {kLeft});
    walls.refine(increment(aside), seen({kLeft}, aside));
    const auto told =
        walls.refine(increment(CPose2D(0.1, 0, 0)), seen({kLeft}, aside + CPose2D(0.1, 0, 0)));
    EXPECT_LT(told.cov(0, 0), 1e-6);
    EXPECT_NEAR(told.cov(1, 1), 0.04 * 0.04, 1e-9);
}

TEST(CWallOdometry, DoesNotTakeTheLeafOfADoorForTheWallBesideIt) {
    const Walls all = {wall({0.5, 1}, {-2, 1}), wall({1.4, 1.12}, {0.5, 1.12}),
                       wall({4, 1}, {1.4, 1}), kRight};
    for (const double slip : {0.1, -0.1}) {
        SCOPED_TRACE(slip);
        const CPose2D pose(0.3, 0.02, 0);
        CWallOdometry both(exact());
        both.refine(increment(CPose2D(0, 0, 0)), all);
        const auto told = both.refine(increment(CPose2D(0.3 + slip, -0.01, 0)), seen(all, pose));
        EXPECT_EQ(both.matched(), 4u);
        EXPECT_NEAR(told.mean.y(), 0.02, 1e-4);
        // The leaf comes in sight only now, and odometry lays an end of it before the wall.
        CWallOdometry late(exact());
        late.refine(increment(CPose2D(0, 0, 0)), {all[0], all[2], all[3]});
        const auto later = late.refine(increment(CPose2D(0.3 + slip, -0.06, 0)), seen(all, pose));
        EXPECT_EQ(late.matched(), 3u);
        EXPECT_NEAR(later.mean.y(), 0.02, 1e-4);
    }
}

TEST(CWallOdometry, SeesAWallFromBehindOnceItHasCrossedItsLine) {
    // The wall lies ahead to the left at y = 0.1; the robot drives past its end to the other side.
    const Walls corner = {wall({4, 0.1}, {1, 0.1}), kAhead};
    for (const double y : {0.3, 0.11, 0.09}) {  // odometry is 0.03 m wrong: either side of the line
        for (const double error : {-0.03, 0.03}) {
            SCOPED_TRACE(y);
            SCOPED_TRACE(error);
            CWallOdometry walls(exact());
            walls.refine(increment(CPose2D(0, 0, 0)), corner);
            const auto told = walls.refine(increment(CPose2D(0.2, y + error, 0.02)),
                                           seen(corner, CPose2D(0.2, y, 0)));
            EXPECT_EQ(walls.matched(), 2u);
            expectPose(told.mean, 0.2, y, 0, 1e-4);
        }
    }
}

TEST(CWallOdometry, RenewsItsReferenceAfterTravel) {
    CWallOdometry walls(exact());
    CPose2D truth;
    walls.refine(increment(truth), {kLeft, kAhead});
    std::vector<std::size_t> matched;
    for (int i = 1; i <= 9; ++i) {  // the right wall comes in sight after the first scan
        truth = truth + CPose2D(0.4, 0, 0);
        walls.refine(increment(CPose2D(0.4, 0, 0)), seen({kLeft, kAhead, kRight}, truth));
        matched.push_back(walls.matched());
    }
    // 3.2 m are more than 3 m: the eighth scan becomes the reference, and the ninth knows all three
    EXPECT_EQ(matched, (std::vector<std::size_t>{2, 2, 2, 2, 2, 2, 2, 2, 3}));
}

TEST(CWallOdometry, LeavesTheMotionAsItIsWithoutWalls) {
    CWallOdometry walls;
    const auto said = increment(CPose2D(0.5, 0.1, 0.2));
    const auto expectUnchanged = [&](const CPosePDFGaussian& told) {
        EXPECT_EQ(walls.matched(), 0u);
        EXPECT_EQ(told.mean, said.mean);
        EXPECT_EQ(told.cov, said.cov);
    };
    expectUnchanged(walls.refine(said, {}));
    expectUnchanged(walls.refine(said, {kLeft}));  // the first that is seen
    expectUnchanged(walls.refine(said, {}));
    expectUnchanged(walls.refine(said, {wall({3, 1}, {2.5, 1})}));  // too short
}

TEST(CWallOdometry, DoesNothingWhenSwitchedOff) {
    TWallOdometryOptions options;
    options.use = false;
    CWallOdometry walls(options);
    walls.refine(increment(CPose2D(0, 0, 0)), {kLeft, kAhead});
    const auto said = increment(CPose2D(0.5, 0.03, 0.02));
    const auto told = walls.refine(said, seen({kLeft, kAhead}, CPose2D(0.5, 0, 0)));
    EXPECT_EQ(told.mean, said.mean);
    EXPECT_EQ(told.cov, said.cov);
}

TEST(CWallOdometry, RefusesOptionsOutOfRange) {
    const auto refused = [](double TWallOdometryOptions::*field, double value) {
        TWallOdometryOptions options;
        options.*field = value;
        EXPECT_THROW(CWallOdometry{options}, std::invalid_argument) << value;
    };
    refused(&TWallOdometryOptions::minLength, 0);
    refused(&TWallOdometryOptions::gateQuantile, 1);
    refused(&TWallOdometryOptions::slack, std::nan(""));
    refused(&TWallOdometryOptions::slackTurn, M_PI / 2);
    refused(&TWallOdometryOptions::maxTravel, -1);
}

/// Squared Mahalanobis distance of a told motion from the true one; the frame is the first robot's.
double nees(const CPosePDFGaussian& told, const CPose2D& truth) {
    const Eigen::Vector3d e(told.mean.x() - truth.x(), told.mean.y() - truth.y(),
                            told.mean.phi() - truth.phi());
    return e.dot(told.cov.asEigen().ldlt().solve(e));
}

/// Mean NEES of the pose after `steps` motions, lines and odometry with the noise that they state.
double meanNees(int steps, int runs) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    // One wall is slanted, so that no error is square to all.
    const Walls truth = {wall({6, 1}, {-6, 1}, 0.01), wall({4, -3}, {6, 1}, 0.01)};
    const auto noisy = [&](Walls lines) {
        for (TLine& line : lines) {
            line.rho += 0.01 * normal(random);
            line.alpha += 0.01 * normal(random);
        }
        return lines;
    };
    double sum = 0;
    for (int run = 0; run < runs; ++run) {
        CWallOdometry walls(exact());
        CPose2D pose;
        CPosePDFGaussian told;
        walls.refine(increment(pose), noisy(truth));
        for (int i = 0; i < steps; ++i) {
            const CPose2D motion(1.5 / steps, 0.3 / steps, 0.4 / steps);
            pose = pose + motion;
            const auto said =
                increment({motion.x() + 0.05 * normal(random), motion.y() + 0.04 * normal(random),
                           motion.phi() + 0.03 * normal(random)});
            const auto step = walls.refine(said, noisy(seen(truth, pose)));
            const Eigen::Matrix3d C = step.cov.asEigen();
            EXPECT_LT((C - C.transpose()).norm(), 1e-15);
            EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(C).eigenvalues()[0], 0);
            told += step;
        }
        sum += nees(told, pose) / runs;
    }
    return sum;
}

TEST(CWallOdometry, StatesItsErrorAsItIs) {
    // The mean of 1000 chi-squared values of three degrees of freedom: 3 with sigma 0.077.
    EXPECT_NEAR(meanNees(1, 1000), 3, 0.31);
}

TEST(CWallOdometry, StatesNoLessThanItsErrorOverManySteps) { EXPECT_LT(meanNees(8, 300), 3.5); }

}  // namespace
}  // namespace salma::laser
