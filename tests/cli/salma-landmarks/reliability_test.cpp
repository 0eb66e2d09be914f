// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <reliability.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace salma::apps {
namespace {

TEST(Reliability, HoldsWhatOneCountsByHand) {
    const std::vector<TJudgedPair> pairs{
        {2, true, "a", "a"}, {0, true, "b", "b"}, {1, false, "a", "b"}, {-1, false, "b", "a"}};
    const auto r = reliability(pairs);
    EXPECT_EQ(r.same, 2U);
    EXPECT_EQ(r.other, 2U);
    EXPECT_NEAR(r.areaUnderCurve.value, 3.0 / 4, 1e-12);
    const auto loss = [](double x) { return std::log1p(std::exp(-x)); };
    EXPECT_NEAR(r.logLoss.value, (loss(2) + loss(0) + loss(-1) + loss(1)) / 4, 1e-12);
    const auto p = [](double x) { return 1 / (1 + std::exp(-x)); };
    EXPECT_NEAR(r.calibrationError.value, ((1 - p(2)) + (1 - p(0)) + p(1) + p(-1)) / 4, 1e-12);
    ASSERT_EQ(r.bins.size(), 4U);
    EXPECT_EQ(r.bins.front().predicted, -1);
    EXPECT_EQ(r.bins.front().other, 1U);
}

TEST(Reliability, CountsEqualRatiosHalf) {
    const auto r = reliability({{1, true, "a", "a"}, {1, false, "a", "b"}});
    EXPECT_NEAR(r.areaUnderCurve.value, 0.5, 1e-12);
}

TEST(Reliability, WeighsBothKindsTheSameWhateverTheirNumbers) {
    // Half of the same and a quarter of the others fall into one bin: the ratio there is 2.
    std::vector<TJudgedPair> pairs;
    for (int i = 0; i < 10; ++i) pairs.push_back({i < 5 ? 0.5 : 3.5, true, "a", "a"});
    for (int i = 0; i < 400; ++i) pairs.push_back({i < 100 ? 0.5 : -2.5, false, "a", "b"});
    const auto r = reliability(pairs);
    ASSERT_EQ(r.bins.size(), 3U);
    EXPECT_NEAR(r.bins[1].counted.value, std::log(2), 1e-9);
    const auto share = proportion(5, 105);
    EXPECT_NEAR(r.bins[1].counted.low, std::log(share.low / (1 - share.low) * 40), 1e-9);
    EXPECT_NEAR(r.bins[1].counted.high, std::log(share.high / (1 - share.high) * 40), 1e-9);
    EXPECT_TRUE(std::isinf(r.bins[0].counted.low));
    EXPECT_TRUE(std::isinf(r.bins[2].counted.high));
}

TEST(Reliability, FindsNoErrorWhereThePredictionsAreRight) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1), ratio(-3.9, 5.9);
    std::vector<TJudgedPair> right, doubled;
    for (int i = 0; i < 100000; ++i) {
        const double x = ratio(random);
        const bool same = uniform(random) < 1 / (1 + std::exp(-x));
        right.push_back({x, same, "a", "a"});
        doubled.push_back({2 * x, same, "a", "a"});
    }
    // both kinds weigh the same here, which moves the ratios by that of their numbers
    const auto counts = reliability(right);
    const double shift =
        std::log(static_cast<double>(counts.other) / static_cast<double>(counts.same));
    for (auto& pair : right) pair.logRatio += shift;
    const auto good = reliability(right), bad = reliability(doubled);
    EXPECT_LT(good.calibrationError.value, 0.01);
    EXPECT_GT(bad.calibrationError.value, 0.05);
    EXPECT_LT(good.logLoss.value, bad.logLoss.value);
}

TEST(Reliability, HasIntervalsThatHoldTheValueAndDoNotDependOnTheMachine) {
    std::mt19937 random(5);
    std::vector<TJudgedPair> pairs;
    for (int i = 0; i < 2000; ++i) {
        const std::string a(1, static_cast<char>('a' + random() % 6));
        const std::string b(1, static_cast<char>('a' + random() % 6));
        const double noise = static_cast<double>(random() % 1000) / 250 - 2;
        pairs.push_back({a == b ? 1 + noise : -1 + noise, a == b, a, b});
    }
    const auto r = reliability(pairs), again = reliability(pairs);
    for (const auto* f : {&r.areaUnderCurve, &r.logLoss, &r.calibrationError}) {
        EXPECT_LE(f->low, f->high);
        EXPECT_LT(f->high - f->low, 0.3);
    }
    EXPECT_LE(r.areaUnderCurve.low, r.areaUnderCurve.value);
    EXPECT_GE(r.areaUnderCurve.high, r.areaUnderCurve.value);
    EXPECT_EQ(r.logLoss.low, again.logLoss.low);
}

TEST(Reliability, RefusesWhatItCannotJudge) {
    EXPECT_THROW(reliability({}), std::invalid_argument);
    EXPECT_THROW(reliability({{1, true, "a", "a"}}), std::invalid_argument);
    EXPECT_THROW(reliability({{std::nan(""), true, "a", "a"}, {0, false, "a", "b"}}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace salma::apps
