// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <salma/saliency/CAffineSaliency.h>
#include <salma/saliency/CGreedyClusterer.h>
#include <salma/saliency/CScaleSaliency.h>
#include <salma/saliency/CStableRegions.h>

#include <stdexcept>

namespace salma::saliency {
namespace {

template <class OPTIONS>
OPTIONS load(const std::string& keys) {
    const mrpt::config::CConfigFileMemory file("[section]\n" + keys);
    OPTIONS options;
    options.loadFromConfigFile(file, "section");
    return options;
}

template <class OPTIONS>
void expectReadsWhatItWrites(const OPTIONS& options) {
    const mrpt::config::CConfigFileMemory file(options.asIni("section"));
    OPTIONS read;
    read.loadFromConfigFile(file, "section");
    EXPECT_EQ(read.asIni("section"), options.asIni("section"));
}

TEST(SaliencyOptions, ReadEveryKeyOfDetection) {
    const auto options = load<TScaleSaliencyOptions>(
        "scale_min_px = 4\nscale_max_px = 20\nbins = 32\nlog_base = 2\nsmooth = false\n"
        "stretch = true\nthreads = 2\nsimd = portable\n");
    EXPECT_EQ(options.scaleMin, 4);
    EXPECT_EQ(options.scaleMax, 20);
    EXPECT_EQ(options.bins, 32);
    EXPECT_EQ(options.logBase, ELogBase::two);
    EXPECT_FALSE(options.smooth);
    EXPECT_TRUE(options.stretch);
    EXPECT_EQ(options.threads, 2);
    EXPECT_EQ(options.simd, ESimd::portable);
    expectReadsWhatItWrites(options);
}

TEST(SaliencyOptions, RefuseValuesBeyondTheirRanges) {
    for (const std::string wrong :
         {"scale_min_px = 0", "scale_max_px = 129", "bins = 1", "bins = 257", "log_base = 10",
          "threads = 0", "simd = mmx", "scales = 3"})
        EXPECT_THROW(load<TScaleSaliencyOptions>(wrong), std::invalid_argument) << wrong;
    EXPECT_THROW(load<TScaleSaliencyOptions>("scale_min_px = 10\nscale_max_px = 11"),
                 std::invalid_argument);
    for (const std::string wrong : {"w_min = -1", "method = best", "neighbours = 0",
                                    "max_variance_px2 = -1", "max_variance_px2 = nan"})
        EXPECT_THROW(load<TClusteringOptions>(wrong), std::invalid_argument) << wrong;
    for (const std::string wrong : {"delta = 0", "delta = 255", "min_area_px2 = 0",
                                    "max_area_fraction = 0", "min_diversity = nan"})
        EXPECT_THROW(load<TStableRegionsOptions>(wrong), std::invalid_argument) << wrong;
}

TEST(SaliencyOptions, ReadBackClusteringStableAndAffineRegions) {
    TClusteringOptions clustering;
    clustering.method = EClustering::kadir;
    clustering.wMin = 0.75;
    clustering.neighbours = 12;
    clustering.maxVariance = 4.5;
    expectReadsWhatItWrites(clustering);
    TStableRegionsOptions mser;
    mser.delta = 3;
    mser.minArea = 99;
    mser.maxAreaFraction = 0.125;
    expectReadsWhatItWrites(mser);
    TAffineOptions affine;
    affine.use = true;
    affine.maxRatio = 2.5;
    affine.elongationCost = 0;
    affine.maxSteps = 7;
    expectReadsWhatItWrites(affine);
}

}  // namespace
}  // namespace salma::saliency
