// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/calibration/CCameraCalibrator.h>
#include <salma/calibration/CLaserCameraCalibrator.h>

#include <Eigen/Dense>
#include <cmath>
#include <iostream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "CSimulatedRig.h"

namespace salma::calibration {
namespace {

/// What one calibration missed.
struct TMiss {
    double angle{0};     //!< [rad] Of the whole rotation.
    double distance{0};  //!< [m]
    double offset{0};    //!< [m] With its sign.
    double nees{0};      //!< Of the seven numbers.
};

TMiss missOf(const CSimulatedRig& rig, const TLaserCameraCalibration& result) {
    const auto& truth = rig.T_l_c();
    const auto& found = result.T_l_c;
    Eigen::Matrix<double, 7, 1> error;
    error << found.x() - truth.x(), found.y() - truth.y(), found.z() - truth.z(),
        std::remainder(found.yaw() - truth.yaw(), 2 * M_PI), found.pitch() - truth.pitch(),
        std::remainder(found.roll() - truth.roll(), 2 * M_PI), result.rangeOffset - rig.offset;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d((found - truth).getRotationMatrix().asEigen()));
    TMiss miss;
    miss.angle = std::abs(turn.angle());
    miss.distance = error.head<3>().norm();
    miss.offset = error[6];
    miss.nees = error.dot(result.covariance.ldlt().solve(error));
    return miss;
}

TLaserCameraCalibration calibrate(const CSimulatedRig& rig,
                                  const std::vector<TLaserBoardPair>& pairs,
                                  const TLaserCameraOptions& options = {}) {
    return CLaserCameraCalibrator(options).calibrate(rig.camera(), rig.board(), pairs);
}

TEST(LaserCamera, FindsPoseAndOffsetFromFifteenBoardsWithAConsistentCovariance) {
    constexpr int runs = 100;
    double angle = 0, distance = 0, offset = 0, nees = 0;
    TLaserCameraOptions options;
    options.folds = 2;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        CSimulatedRig rig(seed);
        const TMiss miss = missOf(rig, calibrate(rig, rig.pairs(15), options));
        angle += miss.angle / runs;
        distance += miss.distance / runs;
        offset += miss.offset / runs;
        nees += miss.nees / runs;
    }
    std::cout << "mean of 100: " << angle * 180 / M_PI << " deg, " << distance * 1e3
              << " mm, offset wrong by " << offset * 1e3 << " mm, NEES " << nees << "\n";
    EXPECT_LT(angle * 180 / M_PI, 0.1);
    EXPECT_LT(distance, 0.003);
    EXPECT_LT(std::abs(offset), 0.001);
    // 95 % of the mean of 100 values of chi-square with 7 degrees of freedom
    EXPECT_GT(nees, 6.28);
    EXPECT_LT(nees, 7.75);
}

TEST(LaserCamera, SaysTheSameTwice) {
    CSimulatedRig rig(3);
    const auto pairs = rig.pairs(10);
    const auto once = calibrate(rig, pairs), again = calibrate(rig, pairs);
    EXPECT_EQ(once.T_l_c.asVectorVal(), again.T_l_c.asVectorVal());
    EXPECT_EQ(once.rangeOffset, again.rangeOffset);
}

TEST(LaserCamera, LeavesOutPairsThatDoNotBelongTogether) {
    CSimulatedRig rig(5);
    auto pairs = rig.pairs(20);
    const auto clean = calibrate(rig, pairs);
    for (std::size_t i = 0; i < 5; ++i) std::swap(pairs[i].scan, pairs[i + 1].scan);  // a ring
    const auto result = calibrate(rig, pairs);
    const TMiss miss = missOf(rig, result);
    EXPECT_LT(miss.angle * 180 / M_PI, 0.4);
    EXPECT_LT(miss.distance, 0.015);
    for (std::size_t i = 6; i < 20; ++i) EXPECT_EQ(result.pairs[i].used, clean.pairs[i].used) << i;
    EXPECT_GE(clean.usedPairs(), 18u);
    EXPECT_LE(result.usedPairs(), 16u);  // a wrong one may agree by chance
}

TEST(LaserCamera, WeighsDownBeamsThatEndElsewhere) {
    CSimulatedRig rig(6);
    auto pairs = rig.pairs(15);
    for (auto& pair : pairs)  // a hand before each tenth beam
        for (std::size_t i = 0; i < pair.scan.ranges.size(); i += 10) pair.scan.ranges[i] -= 0.06;
    const TMiss miss = missOf(rig, calibrate(rig, pairs));
    EXPECT_LT(miss.angle * 180 / M_PI, 0.3);
    EXPECT_LT(miss.distance, 0.01);
}

TEST(LaserCamera, TakesReadingsThatAreMissing) {
    CSimulatedRig rig(7);
    auto pairs = rig.pairs(12);
    for (auto& pair : pairs)
        for (std::size_t i = 0; i < pair.scan.ranges.size(); i += 5)
            pair.scan.ranges[i] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_LT(missOf(rig, calibrate(rig, pairs)).distance, 0.012);
}

TEST(LaserCamera, WithoutOffsetTakesRangesAsTheyAre) {
    CSimulatedRig rig(8);
    rig.offset = 0;
    TLaserCameraOptions options;
    options.estimateOffset = false;
    const auto result = calibrate(rig, rig.pairs(15), options);
    EXPECT_EQ(result.rangeOffset, 0);
    EXPECT_EQ(result.covariance(6, 6), 0);
    EXPECT_LT((result.T_l_c - rig.T_l_c()).norm(), 0.008);
}

TEST(LaserCamera, TakesOutThatDarkSquaresAreRangedShorter) {
    CSimulatedRig rig(12);
    rig.dark = -0.04;
    auto pairs = rig.pairs(15);
    for (auto& pair : pairs) pair.firstIsDark = true;
    const auto known = calibrate(rig, pairs);
    EXPECT_NEAR(known.darkOffset, -0.04, 4 * known.sigmaDark);
    EXPECT_LT(known.sigmaDark, 0.002);
    EXPECT_LT(missOf(rig, known).distance, 0.008);
    EXPECT_LT(missOf(rig, known).nees, 18.5);  // 99 % of chi-square with 7 degrees of freedom
    for (auto& pair : pairs) pair.firstIsDark.reset();
    const auto unknown = calibrate(rig, pairs);
    EXPECT_EQ(unknown.darkOffset, 0);
    EXPECT_GT(unknown.medianFitted(), 2 * known.medianFitted());
}

TEST(LaserCamera, HoldsOutBoardsThatFitAsWell) {
    CSimulatedRig rig(9);
    const auto result = calibrate(rig, rig.pairs(20));
    // The median of a normal distribution, shortened where beams meet a board at an angle.
    EXPECT_LT(result.medianFitted(), 0.6745 * 0.005);
    EXPECT_GT(result.medianFitted(), 0.4 * 0.6745 * 0.005);
    EXPECT_LT(result.medianHeldOut(), 1.2 * result.medianFitted());
}

/// The message of the error; "" if there is none.
std::string messageOf(const CSimulatedRig& rig, const std::vector<TLaserBoardPair>& pairs) {
    try {
        calibrate(rig, pairs);
    } catch (const std::exception& e) {
        return e.what();
    }
    return "";
}

TEST(LaserCamera, RefusesPairsThatDetermineNoPose) {
    CSimulatedRig rig(10);
    const auto good = rig.pairs(8);
    EXPECT_NE(messageOf(rig, {}).find("no pose of the camera agrees"), std::string::npos);
    EXPECT_NE(messageOf(rig, {good.begin(), good.begin() + 4}).find("no pose"), std::string::npos);
    const std::vector<TLaserBoardPair> same(8, good[0]);
    EXPECT_NE(messageOf(rig, same).find("no pose"), std::string::npos);

    auto empty = good;
    for (auto& pair : empty)
        for (double& r : pair.scan.ranges) r = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(messageOf(rig, empty).find("no pose"), std::string::npos);
    auto constant = good;
    for (auto& pair : constant)
        for (double& r : pair.scan.ranges) r = 3;
    EXPECT_NE(messageOf(rig, constant).find("no pose"), std::string::npos);

    auto few = good;
    few[2].pixels.pop_back();
    EXPECT_NE(messageOf(rig, few).find("picture 2: 53 points for a board of 54"),
              std::string::npos);
    auto holed = good;
    holed[2].pixels[7].y = std::nan("");
    EXPECT_NE(messageOf(rig, holed).find("picture 2: a point that is not finite"),
              std::string::npos);
    auto bare = good;
    bare[1].scan.ranges.clear();
    EXPECT_NE(messageOf(rig, bare).find("picture 1: a scan without ranges"), std::string::npos);
}

TEST(LaserCamera, RefusesOptionsOutOfRange) {
    TLaserCameraOptions options;
    options.minPairs = 4;
    EXPECT_THROW(CLaserCameraCalibrator{options}, std::invalid_argument);
}

TEST(LaserCamera, FitsRealBoardsThatWereLeftOutAsWellAsTheOthers) {
    SALMA_NEED_DATA(folder, "calibration/urg_checkerboard_pairs");
    TBoard board;
    board.square = 0.09;
    const auto scans = readScans(folder + "/laser.txt", 31, 31);
    std::vector<TBoardView> views;
    std::vector<TLaserBoardPair> pairs;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const std::string name = folder + "/RGB" + std::to_string(31 + i) + ".png";
        const cv::Mat grey = cv::imread(name, cv::IMREAD_GRAYSCALE);
        const auto points = findBoard(grey, board);
        ASSERT_TRUE(points) << name;
        views.push_back({name, *points});
        pairs.push_back({name, *points, scans[i], firstSquareIsDark(grey, board, *points)});
    }
    const auto camera = CCameraCalibrator().calibrate(board.points(), views, {640, 480}).camera;
    const auto result = CLaserCameraCalibrator().calibrate(camera, board, pairs);
    EXPECT_EQ(result.usedPairs(), 31u);
    EXPECT_LT(result.medianHeldOut(), 1.2 * result.medianFitted());
    EXPECT_LT(result.medianFitted(), 0.010);
    EXPECT_LT(result.darkOffset, -0.02);  // a URG ranges dark squares shorter
}

}  // namespace
}  // namespace salma::calibration
