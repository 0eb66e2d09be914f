// SPDX-License-Identifier: BSD-3-Clause
#include "meanInterval.h"

#include <gtest/gtest.h>

#include <cmath>

namespace salma::apps {
namespace {

const double kNone = std::nan("");

TEST(MeanInterval, IsStudentsForThreeValues) {
    // s = 1, n = 3: t(0.975, 2) = 4.302653 (tables), half width t / sqrt(3)
    const TMean mean = meanInterval({1, 2, 3});
    EXPECT_EQ(mean.count, 3u);
    EXPECT_DOUBLE_EQ(mean.mean, 2);
    EXPECT_NEAR(mean.high - 2, 4.302653 / std::sqrt(3.0), 1e-6);
    EXPECT_NEAR(2 - mean.low, 4.302653 / std::sqrt(3.0), 1e-6);
}

TEST(MeanInterval, LeavesOutWhatIsNotKnown) {
    EXPECT_EQ(meanInterval({kNone, 4, kNone}).count, 1u);
    EXPECT_DOUBLE_EQ(meanInterval({kNone, 4, kNone}).mean, 4);
    EXPECT_TRUE(std::isnan(meanInterval({kNone, 4}).low)) << "one value tells no spread";
    EXPECT_TRUE(std::isnan(meanInterval({}).mean));
    EXPECT_TRUE(std::isnan(meanInterval({kNone}).mean));
}

TEST(Median, IsTheMiddleOne) {
    EXPECT_DOUBLE_EQ(median({9, 1, 2}), 2);
    EXPECT_DOUBLE_EQ(median({4, 1, 2, 9}), 3);
    EXPECT_TRUE(std::isnan(median({})));
    EXPECT_TRUE(std::isnan(median({1, kNone})));
}

}  // namespace
}  // namespace salma::apps
