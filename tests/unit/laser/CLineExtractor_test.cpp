// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/laser/CLineExtractor.h>

#include <Eigen/Dense>
#include <limits>

#include "segmentWorld.h"

namespace salma::laser {
namespace {

using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using test::castScan;

const test::TScanner kExact;
const test::TScanner kSick{361, M_PI, 0.005, 0.01, 0.0005};

test::TWorld room() { return test::polygon({{-3, -2}, {3, -2}, {3, 2}, {-3, 2}}); }

TEST(CLineExtractor, FindsNothingInAnEmptyScan) {
    EXPECT_TRUE(CLineExtractor().extract(mrpt::obs::CObservation2DRangeScan()).lines.empty());
    std::mt19937 random(1);
    const auto dark = castScan({}, CPose2D(), kExact, random);
    const auto result = CLineExtractor().extract(dark);
    EXPECT_TRUE(result.lines.empty());
    EXPECT_EQ(result.invalidPoints, 361U);
}

TEST(CLineExtractor, ReadsTheWallsOfARoomCounterClockwise) {
    std::mt19937 random(1);
    const auto result = CLineExtractor().extract(castScan(room(), CPose2D(), kExact, random));
    ASSERT_EQ(result.lines.size(), 3U);  // the one behind is not seen
    const double rho[] = {2, 3, 2};
    const double alpha[] = {-M_PI / 2, 0, M_PI / 2};
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(result.lines[i].rho, rho[i], 1e-5);
        EXPECT_NEAR(result.lines[i].alpha, alpha[i], 1e-5);
    }
    EXPECT_NEAR(result.lines[1].from.y, -2, 0.06);
    EXPECT_NEAR(result.lines[1].to.y, 2, 0.06);
    EXPECT_EQ(result.loosePoints, 0U);
    EXPECT_LT(result.lines[0].lastPoint, result.lines[1].firstPoint);
}

TEST(CLineExtractor, AppliesThePoseOfTheScannerOnTheRobot) {
    std::mt19937 random(1);
    auto scan = castScan(room(), CPose2D(0.3, -0.2, 0.5), kExact, random);
    scan.sensorPose = CPose3D(0.3, -0.2, 0.7, 0.5, 0, 0);
    for (const TLine& line : CLineExtractor().extract(scan).lines) {
        const double side = mrpt::math::wrapToPi(line.alpha);
        const bool frontOrBack = std::abs(std::sin(side)) < 0.5;
        EXPECT_NEAR(line.rho, frontOrBack ? 3 : 2, 1e-4);
        EXPECT_NEAR(std::sin(2 * side), 0, 1e-4);
    }
}

TEST(CLineExtractor, UnderstandsAScannerMountedUpsideDown) {
    std::mt19937 random(1);
    const auto upright = castScan(room(), CPose2D(0, 0, 0.3), kExact, random);
    auto hanging = upright;
    for (std::size_t i = 0; i < 361; ++i) hanging.setScanRange(i, upright.getScanRange(360 - i));
    hanging.sensorPose = CPose3D(0, 0, 1, 0, 0, M_PI);
    const auto a = CLineExtractor().extract(upright).lines;
    const auto b = CLineExtractor().extract(hanging).lines;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a[i].rho, b[i].rho, 1e-5);
        EXPECT_NEAR(a[i].alpha, b[i].alpha, 1e-5);
        EXPECT_NEAR(a[i].from.x, b[i].from.x, 1e-4);
        EXPECT_EQ(a[i].firstPoint, 360 - b[i].lastPoint);
    }
}

TEST(CLineExtractor, LeavesAScannerThatLooksUpAlone) {
    std::mt19937 random(1);
    auto scan = castScan(room(), CPose2D(), kExact, random);
    scan.sensorPose = CPose3D(0, 0, 0, 0, -0.4, 0);
    const auto result = CLineExtractor().extract(scan);
    EXPECT_TRUE(result.tilted);
    EXPECT_TRUE(result.lines.empty());
}

TEST(CLineExtractor, IgnoresReadingsThatAreNoRanges) {
    std::mt19937 random(1);
    auto scan = castScan(room(), CPose2D(), kExact, random);
    scan.setScanRange(20, std::numeric_limits<float>::quiet_NaN());
    scan.setScanRange(60, 0);
    scan.setScanRange(150, std::numeric_limits<float>::infinity());
    scan.setScanRange(180, -1);
    scan.setScanRange(220, 30);
    scan.setScanRangeValidity(300, false);
    const auto result = CLineExtractor().extract(scan);
    EXPECT_EQ(result.invalidPoints, 6U);
    EXPECT_EQ(result.lines.size(), 3U);
}

TEST(CLineExtractor, SplitsAWallAtAnOpeningButNotAtAThinPost) {
    const test::TWorld opening{{{2, -2}, {2, -0.5}}, {{2, 0.5}, {2, 2}}};
    const test::TWorld post{{{2, -2}, {2, 2}}, {{1, -0.04}, {1, 0.04}}};
    std::mt19937 random(1);
    EXPECT_EQ(CLineExtractor().extract(castScan(opening, CPose2D(), kSick, random)).lines.size(),
              2U);
    const auto lines = CLineExtractor().extract(castScan(post, CPose2D(), kSick, random)).lines;
    ASSERT_GE(lines.size(), 1U);
    EXPECT_NEAR(lines[0].length(), 4, 0.1);
}

TEST(CLineExtractor, SeesADoorLeafBehindItsJambsAsALineOfItsOwn) {
    std::mt19937 random(3);
    const auto world = test::polygon(test::corridorOutline());
    const auto lines =
        CLineExtractor().extract(castScan(world, CPose2D(0, 0, M_PI / 2), kSick, random)).lines;
    std::size_t leaves = 0;
    std::size_t walls = 0;
    for (const TLine& line : lines) {
        if (std::abs(std::sin(line.alpha)) > 0.1 || line.length() < 0.3) continue;
        const double depth = (line.from.x + line.to.x) / 2;
        leaves += std::abs(depth - 1.12) < 0.01;
        walls += std::abs(depth - 1) < 0.01;
        EXPECT_TRUE(std::abs(depth - 1.12) < 0.01 || std::abs(depth - 1) < 0.01) << depth;
    }
    EXPECT_GE(leaves, 3U);
    EXPECT_GE(walls, 4U);
}

TEST(CLineExtractor, StatesTheCovarianceOfRhoAndAlphaThatTheErrorsHave) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    const test::TWorld wall{{{2, -1.5}, {2, 1.5}}};
    const int runs = 500;
    double nees = 0;
    for (int i = 0; i < runs; ++i) {
        const CPose2D pose(unit(random), unit(random), 0.8 * unit(random));
        const auto lines = CLineExtractor().extract(castScan(wall, pose, kSick, random)).lines;
        ASSERT_EQ(lines.size(), 1U) << i;
        const TLine seen = transformed(lines[0], pose);
        const Eigen::Vector2d error(seen.rho - 2, mrpt::math::wrapToPi(seen.alpha));
        nees += error.dot(seen.covariance.inverse() * error) / runs;
    }
    // mean of chi-square(2) over 500 runs: 2 +- 0.09; rounding is not quite Gaussian
    EXPECT_GT(nees, 1.6);
    EXPECT_LT(nees, 2.4);
}

TEST(CLineExtractor, GivesTheSameLinesEachTime) {
    std::mt19937 random(5);
    const auto world = test::polygon(test::corridorOutline());
    const auto scan = castScan(world, CPose2D(1, 0.2, 0.4), kSick, random);
    const CLineExtractor extractor;
    const auto a = extractor.extract(scan).lines;
    const auto b = extractor.extract(scan).lines;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].rho, b[i].rho);
}

TEST(CLineExtractor, SurvivesNonsense) {
    std::mt19937 random(9);
    for (int run = 0; run < 200; ++run) {
        auto scan = castScan(room(), CPose2D(), {1 + random() % 400, M_PI}, random);
        for (std::size_t i = 0; i < scan.getScanSize(); ++i)
            if (random() % 3 == 0)
                scan.setScanRange(i, static_cast<float>(random() % 1000) * 0.03F - 1);
        for (const TLine& line : CLineExtractor().extract(scan).lines) {
            EXPECT_TRUE(std::isfinite(line.rho + line.alpha + line.covariance.sum()));
            EXPECT_GE(line.points, 4U);
        }
    }
}

}  // namespace
}  // namespace salma::laser
