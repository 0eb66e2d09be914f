// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/simulator/CLaserModel.h>
#include <salma/simulator/CNoddingLaserModel.h>

#include <cmath>

#include "room.h"

namespace salma::simulator {
namespace {

constexpr double kFiveSigma = 0.026;  // with rounding [m]

/// Quiet but for the noise of a range.
TLaserOptions laserOptions() {
    TLaserOptions options;
    options.maxOffset = 0;
    options.beamWidth = 1e-6;
    return options;
}

}  // namespace

TEST(CNoddingLaserModel, SeesWhatTheLevelLaserSeesWhereItIsLevel) {
    const test::CTemporaryFolder folder;
    const CWorld world(load(folder, roomIni()));
    TNoddingOptions nodding;
    nodding.lowest = -nodding.highest;
    const auto sweep = CNoddingLaserModel(laserOptions(), nodding, world, 1).sweep({1, 0.5, 1}, 0);
    const auto truth = CLaserModel(laserOptions(), world, 1).trueRanges({1, 0.5, 1});
    const auto& level = sweep[30];
    EXPECT_NEAR(level.sensorPose.pitch(), 0, 1e-12);
    ASSERT_EQ(level.getScanSize(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
        EXPECT_NEAR(level.getScanRange(i), truth[i], kFiveSigma) << i;
}

TEST(CNoddingLaserModel, LooksDownAtTheFloorAndUpAtTheWall) {
    const test::CTemporaryFolder folder;
    const CWorld world(load(folder, roomIni()));
    const auto sweep = CNoddingLaserModel(laserOptions(), {}, world, 1).sweep({0, 0, 0}, 0);
    ASSERT_EQ(sweep.size(), 61U);
    const double degree = M_PI / 180;
    // the middle beam: down to the floor 0.4 m below, up to the wall 4 - 0.18 m ahead, or the
    // ceiling 2.2 m above
    EXPECT_NEAR(sweep.front().getScanRange(180), 0.4 / std::sin(20 * degree), kFiveSigma);
    EXPECT_NEAR(sweep.front().sensorPose.pitch(), 20 * degree, 1e-9);
    EXPECT_NEAR(sweep[40].getScanRange(180), 3.82 / std::cos(20 * degree), kFiveSigma);
    EXPECT_NEAR(sweep.back().getScanRange(180), 2.2 / std::sin(40 * degree), kFiveSigma);
    double x = 0, y = 0, z = 0;
    sweep.front().sensorPose.composePoint(sweep.front().getScanRange(180), 0, 0, x, y, z);
    EXPECT_NEAR(z, 0, kFiveSigma);
}

TEST(CNoddingLaserModel, AMountThatMovesTiltsEachBeamByItself) {
    const test::CTemporaryFolder folder;
    const CWorld world(load(folder, roomIni()));
    const double degree = M_PI / 180;
    const auto scan = CNoddingLaserModel(laserOptions(), {}, world, 1)
                          .scan({0, 0, 0}, -10 * degree, 10 * degree, std::uint64_t{0});
    EXPECT_NEAR(scan.sensorPose.pitch(), 0, 1e-12);
    // 45 deg to the right, tilted by -5 deg: the wall 1.5 m to the side; turning about the level
    // axis leaves y alone
    EXPECT_NEAR(scan.getScanRange(90), 1.5 / std::sin(45 * degree), kFiveSigma);
    // 10 deg to the left, tilted by 10 / 9 deg: the wall 3.82 m ahead
    EXPECT_NEAR(scan.getScanRange(200), 3.82 / (std::cos(10 * degree) * std::cos(10 * degree / 9)),
                kFiveSigma);
}

TEST(CNoddingLaserModel, RefusesASweepThatIsNone) {
    const test::CTemporaryFolder folder;
    const CWorld world(load(folder, roomIni()));
    TNoddingOptions nodding;
    nodding.scans = 1;
    EXPECT_THROW(CNoddingLaserModel(laserOptions(), nodding, world, 1), std::invalid_argument);
    nodding = {};
    nodding.lowest = nodding.highest;
    EXPECT_THROW(CNoddingLaserModel(laserOptions(), nodding, world, 1), std::invalid_argument);
}

}  // namespace salma::simulator
