// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/CGreedyClusterer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

namespace salma::saliency {
namespace {

using observations::TSalientRegion;

TSalientRegion region(double x, double y, double s, double W, double Y) {
    return {x, y, s, Y / W, W, Y};
}

/// The definition, in quadratic time.
std::vector<TSalientRegion> referenceCluster(std::vector<TSalientRegion> peaks, double wMin) {
    std::vector<TSalientRegion> kept;
    while (true) {
        const TSalientRegion* top = nullptr;
        for (const auto& p : peaks)
            if (p.W > wMin && (top == nullptr || p.Y > top->Y)) top = &p;
        if (top == nullptr) return kept;
        kept.push_back(*top);
        const TSalientRegion t = *top;
        const auto covered = [&t](const TSalientRegion& p) {
            return (p.x - t.x) * (p.x - t.x) + (p.y - t.y) * (p.y - t.y) <= t.s * t.s;
        };
        peaks.erase(std::remove_if(peaks.begin(), peaks.end(), covered), peaks.end());
    }
}

std::vector<TSalientRegion> randomPeaks(std::size_t count, double width, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<TSalientRegion> peaks;
    for (std::size_t i = 0; i < count; ++i)
        peaks.push_back(region(width * unit(random) - 100, width * unit(random) + 40,
                               3 + 30 * unit(random), 1.5 * unit(random), 3 * unit(random)));
    return peaks;
}

TEST(CGreedyClusterer, DeletesAWeakerPeakOnTheRimOfAStrongerOneAndKeepsOneBeyond) {
    const auto result = CGreedyClusterer().cluster(
        {region(15, 10, 3, 1, 1.0), region(10, 10, 5, 1, 2.0), region(15.001, 10, 3, 1, 1.1)});
    ASSERT_EQ(result.regions.size(), 2u);
    EXPECT_EQ(result.regions[0].Y, 2.0);
    EXPECT_EQ(result.regions[1].Y, 1.1);
    EXPECT_EQ(result.insideStronger, 1u);
    EXPECT_EQ(result.belowWMin, 0u);
}

TEST(CGreedyClusterer, LetsADeletedPeakDeleteNothing) {
    // The second lies within the first, the third within the second only.
    const auto result = CGreedyClusterer().cluster(
        {region(0, 0, 5, 1, 3), region(4, 0, 20, 1, 2), region(12, 0, 4, 1, 1)});
    ASSERT_EQ(result.regions.size(), 2u);
    EXPECT_EQ(result.regions[1].x, 12);
}

TEST(CGreedyClusterer, DropsPeaksWhoseInterScaleSaliencyDoesNotExceedTheLimit) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto result = CGreedyClusterer().cluster(
        {region(0, 0, 5, 0.5, 3), region(50, 0, 5, 0.51, 2), {90, 0, 5, 1, nan, 1}});
    ASSERT_EQ(result.regions.size(), 1u);
    EXPECT_EQ(result.regions[0].x, 50);
    EXPECT_EQ(result.belowWMin, 2u);
}

TEST(CGreedyClusterer, AgreesWithTheDefinitionOnRandomPeaks) {
    for (const double width : {10.0, 200.0, 100000.0}) {
        const auto peaks = randomPeaks(800, width, 3);
        const auto expected = referenceCluster(peaks, 0.5);
        const auto found = CGreedyClusterer().cluster(peaks);
        ASSERT_EQ(found.regions.size(), expected.size()) << width;
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(found.regions[i].Y, expected[i].Y);
        EXPECT_EQ(found.belowWMin + found.insideStronger + found.regions.size(), peaks.size());
    }
}

TEST(CGreedyClusterer, GivesTheSameRegionsForAnyOrderOfEqualPeaks) {
    std::vector<TSalientRegion> peaks;
    for (int row = 0; row < 10; ++row)
        for (int column = 0; column < 10; ++column)
            peaks.push_back(region(column * 4, row * 4, 6, 1, 2));
    const auto expected = CGreedyClusterer().cluster(peaks).regions;
    EXPECT_EQ(expected[0].x, 0);  // the first row's first
    EXPECT_EQ(expected[0].y, 0);
    std::shuffle(peaks.begin(), peaks.end(), std::mt19937(5));
    const auto found = CGreedyClusterer().cluster(peaks).regions;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_EQ(std::make_pair(found[i].x, found[i].y),
                  std::make_pair(expected[i].x, expected[i].y));
}

TEST(CGreedyClusterer, FindsNothingInNothing) {
    EXPECT_TRUE(CGreedyClusterer().cluster({}).regions.empty());
}

TEST(CGreedyClusterer, RefusesPeaksThatAreNotFiniteOrNotInAnyPicture) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const TSalientRegion& bad :
         {region(infinity, 0, 5, 1, 1), region(0, -1e300, 5, 1, 1), region(0, 0, 2e9, 1, 1),
          region(0, 0, 5, 1, infinity), region(0, std::nan(""), 5, 0.1, 1)})
        EXPECT_THROW(CGreedyClusterer().cluster({bad}), std::invalid_argument);
}

TEST(CGreedyClusterer, AgreesWithALoopOverTheKeptOnesOnManyPeaksOfWholePixelsAndEqualSaliency) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> place(0, 299), scale(4, 32), level(1, 500);
    std::vector<TSalientRegion> peaks;
    peaks.reserve(20000);
    for (int i = 0; i < 20000; ++i)
        peaks.push_back(region(place(random), place(random), scale(random), level(random) / 250.0,
                               level(random) / 100.0));
    auto sorted = peaks;
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
        return std::make_tuple(-a.Y, a.y, a.x, a.s, a.W) <
               std::make_tuple(-b.Y, b.y, b.x, b.s, b.W);
    });
    std::vector<TSalientRegion> expected;
    for (const auto& p : sorted) {
        const auto covers = [&p](const TSalientRegion& k) {
            return (p.x - k.x) * (p.x - k.x) + (p.y - k.y) * (p.y - k.y) <= k.s * k.s;
        };
        if (p.W > 0.5 && std::none_of(expected.begin(), expected.end(), covers))
            expected.push_back(p);
    }
    const auto found = CGreedyClusterer().cluster(peaks).regions;
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_GT(found.size(), 100u);
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_EQ(std::make_tuple(found[i].x, found[i].y, found[i].s, found[i].Y),
                  std::make_tuple(expected[i].x, expected[i].y, expected[i].s, expected[i].Y));
}

}  // namespace
}  // namespace salma::saliency
