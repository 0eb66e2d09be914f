// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>
#include <salma/drivers/CNoddingSweep.h>

#include <cmath>

using namespace salma::drivers;
using mrpt::DEG2RAD;

namespace {

TPlacedScan at(double degrees) { return {nullptr, DEG2RAD(degrees), {}}; }

}  // namespace

TEST(CElevationHistory, InterpolatesBetweenNeighbours) {
    CElevationHistory history;
    history.add(10, 0.1);
    history.add(10.5, 0.3);
    history.add(12, 0.4);
    EXPECT_NEAR(*history.at(10.25, 1), 0.2, 1e-12);
    EXPECT_NEAR(*history.at(10.5, 1), 0.3, 1e-12);
    EXPECT_NEAR(*history.at(10, 1), 0.1, 1e-12);
    EXPECT_FALSE(history.at(9.9, 1));
    EXPECT_FALSE(history.at(12.1, 1));
    EXPECT_FALSE(history.at(11, 1));  // the gap is 1.5 s
    EXPECT_TRUE(history.at(11, 2));
}

TEST(CElevationHistory, AClockThatJumpsBackStartsItAnew) {
    CElevationHistory history;
    EXPECT_FALSE(history.end());
    history.add(100, 0.1);
    history.add(101, 0.2);
    history.add(50, 0.3);
    EXPECT_EQ(*history.end(), 50);
    EXPECT_FALSE(history.at(100.5, 10));
}

TEST(CNoddingSweep, CutsWhereTheMountTurnsRound) {
    CNoddingSweep cutter;
    std::vector<std::vector<TPlacedScan>> sweeps;
    for (int i = 0; i <= 240; ++i) {  // from -20 up to 40 deg, down, up, down, in steps of 1 deg
        const int phase = i % 120;
        const double noise = i % 2 == 0 ? 0.3 : -0.3;
        auto sweep = cutter.add(at((phase <= 60 ? phase - 20 : 100 - phase) + noise));
        if (!sweep.empty()) sweeps.push_back(std::move(sweep));
    }
    ASSERT_EQ(sweeps.size(), 3U);
    for (std::size_t k = 0; k < sweeps.size(); ++k) {
        const double first = mrpt::RAD2DEG(sweeps[k].front().elevation);
        const double last = mrpt::RAD2DEG(sweeps[k].back().elevation);
        EXPECT_NEAR(first, k % 2 == 0 ? -20 : 40, 1.5);
        EXPECT_NEAR(last, k % 2 == 0 ? 40 : -20, 1.5);
        EXPECT_NEAR(static_cast<double>(sweeps[k].size()), 60, 3);
    }
}

TEST(CNoddingSweep, AMountThatStandsStillFillsNoMemory) {
    CNoddingSweep cutter;
    std::size_t most = 0, sum = 0;
    for (std::size_t i = 0; i < 3 * CNoddingSweep::maxScans; ++i) {
        const auto sweep = cutter.add(at(5));
        most = std::max(most, sweep.size());
        sum += sweep.size();
    }
    EXPECT_EQ(most, CNoddingSweep::maxScans);
    EXPECT_EQ(sum, 3 * CNoddingSweep::maxScans);
}
