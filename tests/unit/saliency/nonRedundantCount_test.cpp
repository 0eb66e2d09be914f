// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/nonRedundantCount.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace salma::saliency {
namespace {

TEllipse disc(double u, double v, double radius) {
    return {u, v, 1 / (radius * radius), 0, 1 / (radius * radius)};
}

/// The definition, pixel by pixel on a fixed canvas about the origin.
double reference(const std::vector<TEllipse>& regions, double scale) {
    constexpr int kHalf = 120;
    std::vector<double> largest((2 * kHalf + 1) * (2 * kHalf + 1), 0.0);
    for (const auto& e : regions) {
        std::vector<double> mask;
        double sum = 0;
        for (int y = -kHalf; y <= kHalf; ++y)
            for (int x = -kHalf; x <= kHalf; ++x) {
                const double dx = (x - e.u) / scale;
                const double dy = (y - e.v) / scale;
                const double q = e.a * dx * dx + 2 * e.b * dx * dy + e.c * dy * dy;
                mask.push_back(q <= 1 ? std::exp(-q / 2) : 0);
                sum += mask.back();
            }
        for (std::size_t i = 0; i < mask.size(); ++i)
            largest[i] = std::max(largest[i], mask[i] / sum);
    }
    double sum = 0;
    for (const double value : largest) sum += value;
    return sum;
}

TEST(nonRedundantCount, CountsRegionsThatDoNotTouch) {
    EXPECT_EQ(nonRedundantCount({}, 3), 0);
    EXPECT_NEAR(nonRedundantCount({disc(7.3, 8.1, 4)}, 3), 1, 1e-5);
    EXPECT_NEAR(nonRedundantCount({disc(0, 0, 4), disc(30, 0, 5), disc(0, 900, 50)}, 3), 3, 1e-5);
}

TEST(nonRedundantCount, CountsCopiesOnce) {
    EXPECT_NEAR(nonRedundantCount(std::vector<TEllipse>(25, disc(3.2, 4.4, 6)), 2), 1, 1e-5);
}

TEST(nonRedundantCount, CountsASmallRegionWithinALargeOneNearlyWhole) {
    // The small mask is far higher; of the large one only what lies beneath is lost.
    const double count = nonRedundantCount({disc(0, 0, 2), disc(0, 0, 40)}, 1);
    EXPECT_LT(count, 2);
    EXPECT_GT(count, 2 - 2 * 4.0 / 1600);
}

TEST(nonRedundantCount, AgreesWithTheDefinitionOnRandomEllipses) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> place(-40, 40), axis(2, 20), share(-0.9, 0.9);
    for (const double scale : {0.7, 1.0, 3.0}) {
        std::vector<TEllipse> regions;
        for (int i = 0; i < 30; ++i) {
            const double a = std::pow(axis(random), -2);
            const double c = std::pow(axis(random), -2);
            regions.push_back(
                {place(random), place(random), a, share(random) * std::sqrt(a * c), c});
        }
        const double expected = reference(regions, scale);
        EXPECT_NEAR(nonRedundantCount(regions, scale), expected, 1e-4 * expected) << scale;
    }
}

TEST(nonRedundantCount, CountsARegionSmallerThanAPixel) {
    EXPECT_NEAR(nonRedundantCount({disc(0.5, 0.5, 0.1), disc(9.5, 9.5, 0.1)}, 1), 2, 1e-6);
}

TEST(nonRedundantCount, RefusesWindowsThatAreNotFiniteOrTooLarge) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(nonRedundantCount({disc(nan, 0, 4)}, 3), std::invalid_argument);
    EXPECT_THROW(nonRedundantCount({disc(0, 0, 1e6)}, 3), std::invalid_argument);
    EXPECT_THROW(nonRedundantCount({disc(1e12, 0, 4)}, 3), std::invalid_argument);
    EXPECT_THROW(nonRedundantCount({disc(0, 0, 4)}, 0), std::invalid_argument);
    EXPECT_THROW(nonRedundantCount({disc(0, 0, 4)}, nan), std::invalid_argument);
}

}  // namespace
}  // namespace salma::saliency
