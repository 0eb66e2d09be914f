// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ratioTable.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace salma::apps {
namespace {

TCalibrationOptions options(int bins, double prior, double spoilt) {
    TCalibrationOptions o;
    o.bins = bins;
    o.priorCount = prior;
    o.spoiltRate = spoilt;
    return o;
}

TEST(RatioTable, HoldsWhatOneCountsByHand) {
    // Four bins; of 8 same and 8 other: 0, 1, 3, 4 and 4, 3, 1, 0; the prior is 1/4 a bin.
    const std::vector<double> same{0.3, 0.6, 0.6, 0.6, 0.9, 0.9, 0.9, 1};
    const std::vector<double> other{0, 0.1, 0.1, 0.1, 0.3, 0.3, 0.3, 0.6};
    const auto table = learnTable(same, other, {100, 100}, options(4, 1, 1e-9));
    ASSERT_EQ(table.bins.size(), 4U);
    EXPECT_EQ(table.bins[0].same, 0U);
    EXPECT_EQ(table.bins[0].other, 4U);
    EXPECT_EQ(table.bins[3].same, 4U);
    EXPECT_NEAR(table.bins[0].counted, std::log(0.25 / 4.25), 1e-9);
    EXPECT_NEAR(table.bins[1].counted, std::log(1.25 / 3.25), 1e-9);
    EXPECT_NEAR(table.bins[2].logRatio, std::log(3.25 / 1.25), 1e-6);
    EXPECT_NEAR(table.bins[3].logRatio, std::log(4.25 / 0.25), 1e-6);
    EXPECT_EQ(table.scoreKnots, (std::vector<double>{0, 0.125, 0.375, 0.625, 0.875, 1}));
    EXPECT_NEAR(readRatio(table, 0.5), 0, 0.01) << "half way between two opposite bins";
    EXPECT_NEAR(readRatio(table, 1), std::log(17), 0.01);
    EXPECT_NEAR(readRatio(table, 0), -std::log(17), 0.01);
}

TEST(RatioTable, CountsNoMoreThanIsIndependent) {
    // 8 pairs of each kind that are worth 4 count as 4: half of the counts above.
    const std::vector<double> same{0.3, 0.6, 0.6, 0.6, 0.9, 0.9, 0.9, 1};
    const std::vector<double> other{0, 0.1, 0.1, 0.1, 0.3, 0.3, 0.3, 0.6};
    const auto table = learnTable(same, other, {4, 4}, options(4, 1, 1e-9));
    EXPECT_NEAR(table.bins[3].logRatio, std::log(2.25 / 0.25), 1e-6);
    EXPECT_NEAR(table.bins[2].logRatio, std::log(1.75 / 0.75), 1e-6);
}

TEST(RatioTable, PoolsBinsWhoseRatiosFall) {
    // Bins 1 and 2 have 4:1 and 1:1 of 8 each; pooled 5:2, with two priors of 1/4.
    const std::vector<double> same{0.3, 0.3, 0.3, 0.3, 0.6, 0.9, 0.9, 0.9};
    const std::vector<double> other{0, 0, 0, 0, 0, 0, 0.3, 0.6};
    const auto table = learnTable(same, other, {100, 100}, options(4, 1, 1e-9));
    EXPECT_NEAR(table.bins[1].counted, std::log(4.25 / 1.25), 1e-9);
    EXPECT_NEAR(table.bins[2].counted, std::log(1.25 / 1.25), 1e-9);
    EXPECT_NEAR(table.bins[1].logRatio, std::log(5.5 / 2.5), 1e-6);
    EXPECT_EQ(table.bins[1].logRatio, table.bins[2].logRatio);
    EXPECT_GT(table.bins[3].logRatio, table.bins[2].logRatio);
}

TEST(RatioTable, KeepsNoRatioBelowTheSpoiltShare) {
    const std::vector<double> same(1000, 0.95), other(1000, 0.05);
    const auto table = learnTable(same, other, {1000, 1000}, options(20, 1, 0.05));
    EXPECT_NEAR(table.bins[0].logRatio, std::log(0.05), 0.01);
    EXPECT_TRUE(std::isfinite(table.bins[10].logRatio)) << "nothing was counted there";
    EXPECT_NEAR(table.bins[10].logRatio, 0, 0.01);
    EXPECT_GT(table.bins[19].logRatio, std::log(1000));
}

TEST(RatioTable, FindsTheRatioOfKnownDensities) {
    // p(s|same) = 2 s, p(s|other) = 2 (1 - s): the ratio is s / (1 - s).
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<double> same, other;
    for (int i = 0; i < 200000; ++i) {
        same.push_back(std::sqrt(uniform(random)));
        other.push_back(1 - std::sqrt(uniform(random)));
    }
    const auto table = learnTable(same, other, {2e5, 2e5}, options(20, 1, 1e-9));
    for (const double s : {0.125, 0.275, 0.475, 0.625, 0.875})
        EXPECT_NEAR(readRatio(table, s), std::log(s / (1 - s)), 0.08) << s;
    for (std::size_t i = 1; i < table.logLrKnots.size(); ++i) {
        EXPECT_GT(table.scoreKnots[i], table.scoreKnots[i - 1]);
        EXPECT_GE(table.logLrKnots[i], table.logLrKnots[i - 1]);
    }
}

TEST(RatioTable, RefusesScoresThatAreNone) {
    const std::vector<double> good{0.5};
    EXPECT_THROW(learnTable({}, good, {1, 1}, {}), std::invalid_argument);
    EXPECT_THROW(learnTable(good, {}, {1, 1}, {}), std::invalid_argument);
    EXPECT_THROW(learnTable(good, {std::nan("")}, {1, 1}, {}), std::invalid_argument);
    EXPECT_THROW(learnTable({1.01}, good, {1, 1}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace salma::apps
