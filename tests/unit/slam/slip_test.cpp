// SPDX-License-Identifier: BSD-3-Clause
// Wheels that slip: do the landmarks that are tracked tell how far the robot really came?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "CCorridorWorld.h"

namespace salma::slam {
namespace {

using test::CCorridorWorld;
using test::TCorridorOptions;

constexpr int kSlipAt = 60;  // step, 6 m into the first side

struct TDrive {
    double slip{0};        //!< That the filter told at the slip [m].
    int told{0};           //!< Slips told over the drive.
    double error{0};       //!< Distance from the truth five steps later [m].
    std::size_t twice{0};  //!< Landmarks more than features that were seen.
};

TDrive driveWithSlip(double length, bool explain) {
    TCorridorOptions options;
    options.seed = 4;
    options.slipAt = kSlipAt;
    options.slip = length;
    CCorridorWorld world(options);
    TMapCare care;
    care.slip.use = explain;
    CSalientEKF2D filter({}, {}, CCorridorWorld::ratio, {}, care);
    TDrive drive;
    for (int k = 1; k <= kSlipAt + 5; ++k) {
        filter.process(world.next());
        const double slip = filter.motion().slip.norm();
        drive.told += slip > 0;
        drive.slip += slip;
    }
    const auto pose = filter.pose().mean;
    drive.error = std::hypot(pose.x() - world.pose()[0], pose.y() - world.pose()[1]);
    std::vector<std::size_t> seen = world.truth();
    std::sort(seen.begin(), seen.end());
    const auto features = std::unique(seen.begin(), seen.end()) - seen.begin();
    drive.twice =
        filter.landmarks().size() - std::min<std::size_t>(filter.landmarks().size(), features);
    return drive;
}

TEST(Slip, IsToldByTheLandmarksThatAreTracked) {
    for (const double length : {0.4, -0.4, 0.6}) {
        const TDrive d = driveWithSlip(length, true);
        EXPECT_EQ(d.told, 1) << length;
        EXPECT_NEAR(d.slip, std::abs(length), 0.05) << length;
        EXPECT_LT(d.error, 0.12) << length;
        EXPECT_EQ(d.twice, 0u) << length;
    }
}

TEST(Slip, LeadsAstrayWhereItIsNotTold) { EXPECT_GT(driveWithSlip(0.4, false).error, 0.3); }

TEST(Slip, IsNotToldWhereThereIsNone) {
    const TDrive d = driveWithSlip(0, true);
    EXPECT_EQ(d.told, 0);
    EXPECT_LT(d.error, 0.12);
}

}  // namespace
}  // namespace salma::slam
