// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <proportion.h>

#include <cmath>
#include <stdexcept>

namespace salma::apps {
namespace {

TEST(Proportion, HasTheIntervalsOfPublishedTables) {
    // R: binom.test(5, 10), (8, 10), (95, 100)
    EXPECT_NEAR(proportion(5, 10).low, 0.1870860, 1e-7);
    EXPECT_NEAR(proportion(5, 10).high, 0.8129140, 1e-7);
    EXPECT_NEAR(proportion(8, 10).low, 0.4439045, 1e-7);
    EXPECT_NEAR(proportion(8, 10).high, 0.9747893, 1e-7);
    EXPECT_NEAR(proportion(95, 100).low, 0.8871651, 1e-7);
    EXPECT_NEAR(proportion(95, 100).high, 0.9835681, 1e-7);
}

TEST(Proportion, HasTheClosedFormAtNoneAndAll) {
    for (const std::size_t n : {1U, 10U, 1000U, 100000U}) {
        const double bound = std::pow(0.025, 1 / static_cast<double>(n));
        EXPECT_EQ(proportion(0, n).low, 0);
        EXPECT_NEAR(proportion(0, n).high, 1 - bound, 1e-12);
        EXPECT_NEAR(proportion(n, n).low, bound, 1e-12);
        EXPECT_EQ(proportion(n, n).high, 1);
    }
}

TEST(Proportion, MirrorsWhenFailuresAreCounted) {
    for (std::size_t k = 0; k <= 7; ++k) {
        EXPECT_NEAR(proportion(k, 7).low, 1 - proportion(7 - k, 7).high, 1e-12);
        EXPECT_LE(proportion(k, 7).low, proportion(k, 7).share());
        EXPECT_GE(proportion(k, 7).high, proportion(k, 7).share());
    }
}

TEST(Proportion, SaysNothingOfNothing) {
    const auto none = proportion(0, 0);
    EXPECT_EQ(none.low, 0);
    EXPECT_EQ(none.high, 1);
    EXPECT_TRUE(std::isnan(none.share()));
    EXPECT_THROW(proportion(2, 1), std::invalid_argument);
}

}  // namespace
}  // namespace salma::apps
