// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/CGreedyClusterer.h>
#include <salma/saliency/CKadirClusterer.h>
#include <salma/saliency/CScaleSaliency.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <random>
#include <tuple>

namespace salma::saliency {
namespace {

using observations::TSalientRegion;
using TPeaks = std::vector<TSalientRegion>;

TSalientRegion peak(double x, double y, double s, double Y) { return {x, y, s, Y, 1, Y}; }

TClusteringOptions options(int neighbours, double maxVariance) {
    TClusteringOptions o;
    o.method = EClustering::kadir;
    o.neighbours = neighbours;
    o.maxVariance = maxVariance;
    return o;
}

double distance2(const TSalientRegion& a, const TSalientRegion& b) {
    const double dx = a.x - b.x, dy = a.y - b.y, ds = a.s - b.s;
    return dx * dx + dy * dy + ds * ds;
}

/// The definition: every distance, every time. `sorted` by salience.
TSalientRegion clusterMean(const TPeaks& sorted, std::size_t i, int count, double& variance) {
    std::vector<std::pair<double, std::size_t>> all;
    for (std::size_t j = 0; j < sorted.size(); ++j)
        all.emplace_back(distance2(sorted[j], sorted[i]), j);
    std::partial_sort(all.begin(), all.begin() + count, all.end());
    TSalientRegion mean = sorted[i];
    mean.x = mean.y = mean.s = 0;
    for (int k = 0; k < count; ++k) {
        const auto& p = sorted[all[static_cast<std::size_t>(k)].second];
        mean.x += p.x;
        mean.y += p.y;
        mean.s += p.s;
    }
    mean.x /= count;
    mean.y /= count;
    mean.s /= count;
    variance = 0;
    for (int k = 0; k < count; ++k)
        variance += distance2(sorted[all[static_cast<std::size_t>(k)].second], mean);
    variance /= count;
    return mean;
}

TClusteredRegions referenceCluster(const TPeaks& peaks, const TClusteringOptions& o) {
    TPeaks sorted;
    for (const auto& p : peaks)
        if (p.W > o.wMin) sorted.push_back(p);
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
        return std::make_tuple(-a.Y, a.y, a.x, a.s) < std::make_tuple(-b.Y, b.y, b.x, b.s);
    });
    TClusteredRegions result;
    result.belowWMin = peaks.size() - sorted.size();
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        double variance = std::numeric_limits<double>::infinity();
        TSalientRegion mean;
        if (sorted.size() >= static_cast<std::size_t>(o.neighbours))
            mean = clusterMean(sorted, i, o.neighbours, variance);
        const auto isNear = [&mean](const TSalientRegion& kept) {
            return distance2(kept, mean) <= mean.s * mean.s;
        };
        if (!(variance <= o.maxVariance))
            ++result.scattered;
        else if (std::any_of(result.regions.begin(), result.regions.end(), isNear))
            ++result.insideStronger;
        else
            result.regions.push_back(mean);
    }
    return result;
}

void expectSame(const TClusteredRegions& found, const TClusteredRegions& expected) {
    EXPECT_EQ(found.belowWMin, expected.belowWMin);
    EXPECT_EQ(found.scattered, expected.scattered);
    EXPECT_EQ(found.insideStronger, expected.insideStronger);
    ASSERT_EQ(found.regions.size(), expected.regions.size());
    for (std::size_t i = 0; i < expected.regions.size(); ++i) {
        const auto& f = found.regions[i];
        const auto& e = expected.regions[i];
        EXPECT_EQ(std::make_tuple(f.x, f.y, f.s), std::make_tuple(e.x, e.y, e.s)) << i;
        EXPECT_EQ(std::make_tuple(f.H, f.W, f.Y), std::make_tuple(e.H, e.W, e.Y)) << i;
    }
}

TEST(CKadirClusterer, ReturnsTheMeanPlaceAndScaleOfPeaksThatLieCloseTogether) {
    // Variance: offsets (-1,0,0), (1,0,0), (0,0,-1), (0,0,1) about the mean, so 1.
    const TPeaks peaks{peak(49, 40, 9, 2.0), peak(51, 40, 9, 1.5), peak(50, 40, 8, 1.4),
                       peak(50, 40, 10, 1.3)};
    const auto result = CKadirClusterer(options(4, 1)).cluster(peaks);
    ASSERT_EQ(result.regions.size(), 1u);
    const auto& r = result.regions[0];
    EXPECT_EQ(std::make_tuple(r.x, r.y, r.s), std::make_tuple(50.0, 40.0, 9.0));
    EXPECT_EQ(r.Y, 2.0);
    EXPECT_EQ(result.insideStronger, 3u);
    const auto stricter = CKadirClusterer(options(4, 0.999)).cluster(peaks);
    EXPECT_TRUE(stricter.regions.empty());
    EXPECT_EQ(stricter.scattered, 4u);
}

TEST(CKadirClusterer, DropsASalientPeakThatStandsAlone) {
    const auto result =
        CKadirClusterer(options(2, 1))
            .cluster({peak(100, 100, 5, 3), peak(10, 10, 5, 1), peak(11, 10, 5, 0.9)});
    ASSERT_EQ(result.regions.size(), 1u);
    EXPECT_EQ(result.regions[0].x, 10.5);
    EXPECT_EQ(result.regions[0].Y, 1);
    EXPECT_EQ(result.scattered, 1u);
}

TEST(CKadirClusterer, CountsTheDistanceToStrongerRegionsInScaleToo) {
    // Same place; 12 px of scale apart: farther than the scale of the second only if that is below.
    const auto twoScales = [](double first, double second) {
        return CKadirClusterer(options(1, 0))
            .cluster({peak(50, 50, first, 2), peak(50, 50, second, 1)})
            .regions.size();
    };
    EXPECT_EQ(twoScales(23, 11), 2u);
    EXPECT_EQ(twoScales(24, 12), 1u);  // as far as its scale is not farther
    EXPECT_EQ(twoScales(11, 23), 1u);
}

TEST(CKadirClusterer, AgreesWithTheDefinitionOnWholePixelsFullOfTies) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        std::mt19937 random(seed);
        std::uniform_int_distribution<int> place(0, 39), scale(4, 32), level(1, 40);
        TPeaks peaks;
        for (int i = 0; i < 1500; ++i) {
            const double Y = level(random) / 10.0;
            peaks.push_back({double(place(random)), double(place(random)), double(scale(random)), 1,
                             level(random) / 20.0, Y});
        }
        // Two peaks of equal place, scale and Y would be in no order.
        std::sort(peaks.begin(), peaks.end(), [](const auto& a, const auto& b) {
            return std::tie(a.x, a.y, a.s) < std::tie(b.x, b.y, b.s);
        });
        const auto same = [](const auto& a, const auto& b) {
            return std::tie(a.x, a.y, a.s) == std::tie(b.x, b.y, b.s);
        };
        peaks.erase(std::unique(peaks.begin(), peaks.end(), same), peaks.end());
        std::shuffle(peaks.begin(), peaks.end(), random);
        for (const auto& [neighbours, variance] :
             {std::pair{1, 0.0}, {5, 6.0}, {10, 12.0}, {17, 30.0}, {900, 1e9}}) {
            const auto o = options(neighbours, variance);
            const auto found = CKadirClusterer(o).cluster(peaks);
            expectSame(found, referenceCluster(peaks, o));
            EXPECT_FALSE(found.regions.empty());
        }
    }
}

TEST(CKadirClusterer, AgreesWithTheDefinitionOnPlacesOfAnyKind) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const auto& [width, height, depth] :
         {std::array{300.0, 200.0, 30.0}, {1e6, 0.0, 1.0}, {0.0, 0.0, 20.0}, {1e8, 1e8, 1e8}}) {
        TPeaks peaks;
        for (int i = 0; i < 600; ++i)
            peaks.push_back(peak(width * unit(random) - 50, height * unit(random) - 20,
                                 3 + depth * unit(random), 3 * unit(random)));
        // A crowd in one corner, and one peak far away: few boxes hold nearly all.
        for (int i = 0; i < 200; ++i)
            peaks.push_back(peak(unit(random), unit(random), 3 + unit(random), unit(random)));
        const auto o = options(8, 0.02 * (width * width + depth * depth));
        expectSame(CKadirClusterer(o).cluster(peaks), referenceCluster(peaks, o));
    }
    const auto o = options(3, 0);
    const TPeaks one(300, peak(7, 7, 7, 1));
    expectSame(CKadirClusterer(o).cluster(one), referenceCluster(one, o));
}

TEST(CKadirClusterer, AgreesWithTheDefinitionOnPeaksOfAPicture) {
    cv::Mat picture(100, 110, CV_8UC1);
    cv::RNG noise(9);
    noise.fill(picture, cv::RNG::UNIFORM, 0, 256);
    picture(cv::Rect(0, 0, 55, 60)).setTo(40);
    TScaleSaliencyOptions saliency;
    saliency.scaleMax = 12;
    const auto peaks = CScaleSaliency(saliency).detect(picture);
    TClusteringOptions o;
    o.method = EClustering::kadir;
    const auto found = createClusterer(o)->cluster(peaks);
    expectSame(found, referenceCluster(peaks, o));
    EXPECT_GT(found.regions.size(), 20u);
    EXPECT_GT(found.scattered, 0u);
}

TEST(CKadirClusterer, FindsNothingInNothingAndInTooFewPeaks) {
    EXPECT_TRUE(CKadirClusterer().cluster({}).regions.empty());
    const auto result = CKadirClusterer().cluster({peak(1, 1, 4, 1)});
    EXPECT_TRUE(result.regions.empty());
    EXPECT_EQ(result.scattered, 1u);
}

TEST(CKadirClusterer, RefusesPeaksThatAreNotFinite) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_THROW(CKadirClusterer().cluster({peak(0, 0, infinity, 1)}), std::invalid_argument);
    EXPECT_THROW(CKadirClusterer().cluster({peak(std::nan(""), 0, 5, 1)}), std::invalid_argument);
    EXPECT_THROW(CKadirClusterer(options(0, 1)), std::invalid_argument);
}

TEST(Clusterers, AreChosenByOption) {
    TClusteringOptions o;
    EXPECT_NE(dynamic_cast<CGreedyClusterer*>(createClusterer(o).get()), nullptr);
    o.method = EClustering::kadir;
    EXPECT_NE(dynamic_cast<CKadirClusterer*>(createClusterer(o).get()), nullptr);
    o.wMin = -1;
    EXPECT_THROW(createClusterer(o), std::invalid_argument);
}

}  // namespace
}  // namespace salma::saliency
