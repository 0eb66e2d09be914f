// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/CGreedyClusterer.h>
#include <salma/saliency/CScaleSaliency.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <tuple>

#include "CTemporaryFolder.h"
#include "readGz.h"
#include "referenceScaleSaliency.h"

namespace salma::saliency {
namespace {

using TRegions = std::vector<observations::TSalientRegion>;

/// Rows "row col scale H W Y"; lines that begin with '#' are skipped.
TRegions parseOracle(const std::string& text) {
    TRegions regions;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        observations::TSalientRegion r;
        std::istringstream words(line);
        if (line[0] != '#' && words >> r.y >> r.x >> r.s >> r.H >> r.W >> r.Y) regions.push_back(r);
    }
    return regions;
}

void expectSame(const TRegions& found, const TRegions& expected, double relative) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& f = found[i];
        const auto& e = expected[i];
        ASSERT_EQ(std::make_tuple(f.y, f.x, f.s), std::make_tuple(e.y, e.x, e.s)) << "peak " << i;
        ASSERT_NEAR(f.H, e.H, relative * e.H) << "peak " << i;
        ASSERT_NEAR(f.W, e.W, relative * e.W) << "peak " << i;
        ASSERT_NEAR(f.Y, e.Y, relative * e.Y) << "peak " << i;
    }
}

void expectIdentical(const TRegions& found, const TRegions& expected) {
    expectSame(found, expected, 0);
}

/// Noise of several coarsenesses, with a flat corner so that some windows hold one bin.
cv::Mat texture(int columns, int rows, unsigned seed) {
    cv::RNG random(seed);
    cv::Mat fine(rows, columns, CV_8UC1);
    cv::Mat coarse(rows / 8 + 1, columns / 8 + 1, CV_8UC1);
    random.fill(fine, cv::RNG::UNIFORM, 0, 256);
    random.fill(coarse, cv::RNG::UNIFORM, 0, 256);
    cv::resize(coarse, coarse, fine.size());
    cv::Mat mixed = 0.8 * coarse + 0.1 * fine + 20;
    mixed(cv::Rect(0, 0, columns / 2, rows / 2)).setTo(90);
    return mixed;
}

TScaleSaliencyOptions smallScales() {
    TScaleSaliencyOptions options;
    options.scaleMax = 9;
    return options;
}

void expectAsReference(const cv::Mat& picture, const TScaleSaliencyOptions& options) {
    const auto reference = test::referenceScaleSaliency(picture, options);
    ASSERT_FALSE(reference.empty());
    expectSame(CScaleSaliency(options).detect(picture), reference, 1e-11);
}

TEST(CScaleSaliency, FindsTheOraclesPeaksAndNoOthers) {
    SALMA_NEED_DATA(picture, "saliency_oracle/graf1_320.pgm");
    SALMA_NEED_DATA(peaks, "saliency_oracle/graf1_320.Y.txt.gz");
    const auto expected = parseOracle(test::readGz(peaks));
    ASSERT_EQ(expected.size(), 86467u);
    const cv::Mat grey = cv::imread(picture, cv::IMREAD_GRAYSCALE);
    expectSame(CScaleSaliency().detect(grey), expected, 1e-6);
}

TEST(CScaleSaliency, GivesTheOraclesRegionsOnceClustered) {
    SALMA_NEED_DATA(picture, "saliency_oracle/graf1_320.pgm");
    SALMA_NEED_DATA(regions, "saliency_oracle/graf1_320.regions.txt");
    const cv::Mat grey = cv::imread(picture, cv::IMREAD_GRAYSCALE);
    const auto peaks = CScaleSaliency().detect(grey);
    const auto expected = parseOracle(salma::test::readFile(regions));
    ASSERT_EQ(expected.size(), 383u);
    expectSame(CGreedyClusterer().cluster(peaks).regions, expected, 1e-6);
}

TEST(CScaleSaliency, EqualsTheDefinitionOnPicturesOfOddSizes) {
    expectAsReference(texture(83, 31, 1), smallScales());
    expectAsReference(texture(19, 97, 2), smallScales());  // one column of centres
    expectAsReference(texture(83, 83, 3), smallScales());  // one column and row beyond a tile
}

TEST(CScaleSaliency, EqualsTheDefinitionForTheDefaultScales) {
    expectAsReference(texture(75, 71, 4), TScaleSaliencyOptions());
}

TEST(CScaleSaliency, EqualsTheDefinitionForOtherBins) {
    auto options = smallScales();
    for (const int bins : {2, 7, 64, 256}) {
        options.bins = bins;
        expectAsReference(texture(40, 37, 5), options);
    }
}

TEST(CScaleSaliency, EqualsTheDefinitionForOtherScales) {
    // From 12 on, and at 45, counts do not fit into bytes; 1 to 3 leaves a single scale.
    for (const auto& [low, high] : {std::pair{1, 3}, {1, 8}, {12, 20}, {5, 45}}) {
        auto options = smallScales();
        options.scaleMin = low;
        options.scaleMax = high;
        expectAsReference(texture(2 * high + 9, 2 * high + 12, 6), options);
    }
}

TEST(CScaleSaliency, EqualsTheDefinitionInBitsWithoutSmoothingAndStretched) {
    auto options = smallScales();
    options.logBase = ELogBase::two;
    expectAsReference(texture(40, 37, 7), options);
    options.smooth = false;
    expectAsReference(texture(40, 37, 7), options);
    options.stretch = true;
    expectAsReference(texture(40, 37, 7) * 0.3 + 50, options);
}

TEST(CScaleSaliency, PrunesByAThresholdExactlyThePeaksBelowIt) {
    const cv::Mat picture = texture(150, 140, 8);
    const CScaleSaliency detector;
    const auto all = detector.detect(picture);
    for (const double yMin : {-1.0, 0.8, 1.5, all[all.size() / 2].Y, 1e9}) {
        TRegions expected;
        for (const auto& peak : all)
            if (peak.Y >= yMin) expected.push_back(peak);
        expectIdentical(detector.detect(picture, {yMin}), expected);
    }
}

TEST(CScaleSaliency, LeavesTheBestInTheirOrder) {
    const cv::Mat picture = texture(230, 190, 15);
    auto options = TScaleSaliencyOptions();
    const auto all = CScaleSaliency(options).detect(picture);
    for (const int threads : {1, 3})
        for (const std::size_t best :
             {std::size_t{1}, std::size_t{50}, all.size() - 1, all.size() + 1}) {
            auto byY = all;
            std::stable_sort(byY.begin(), byY.end(),
                             [](const auto& a, const auto& b) { return a.Y > b.Y; });
            byY.resize(std::min(best, byY.size()));
            std::stable_sort(byY.begin(), byY.end(), [](const auto& a, const auto& b) {
                return std::make_tuple(a.y, a.x, a.s) < std::make_tuple(b.y, b.x, b.s);
            });
            options.threads = threads;
            expectIdentical(CScaleSaliency(options).detect(picture, {0, best}), byY);
        }
}

TEST(CScaleSaliency, TakesTheFirstOfEqualPeaks) {
    cv::Mat picture(64, 300, CV_8UC1);  // a pattern that repeats, so that peaks of one Y do
    for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.cols; ++x)
            picture.at<std::uint8_t>(y, x) =
                (x % 20) * (x % 20) + (y % 20) * (y % 20) < 70 ? 200 : 40;
    const CScaleSaliency detector(smallScales());
    const auto all = detector.detect(picture);
    const auto largest = std::max_element(all.begin(), all.end(),
                                          [](const auto& a, const auto& b) { return a.Y < b.Y; });
    ASSERT_GT(
        std::count_if(all.begin(), all.end(), [&](const auto& p) { return p.Y == largest->Y; }), 1);
    expectIdentical(detector.detect(picture, {0, 1}), {*largest});
}

TEST(CScaleSaliency, FindsInAPartOfThePictureWhatIsThereInTheWhole) {
    const cv::Mat picture = texture(190, 150, 16);
    const CScaleSaliency detector;
    const auto all = detector.detect(picture);
    for (const cv::Rect& part :
         {cv::Rect(40, 50, 70, 30), cv::Rect(-5, -9, 60, 800), cv::Rect(90, 80, 1, 1)}) {
        TRegions expected;
        for (const auto& peak : all)
            if (part.contains(cv::Point2d(peak.x, peak.y))) expected.push_back(peak);
        expectIdentical(detector.detect(picture, {0, 0, part}), expected);
    }
    EXPECT_TRUE(detector.detect(picture, {0, 0, cv::Rect(0, 0, 30, 150)}).empty());  // no centres
    EXPECT_TRUE(detector.detect(picture, {0, 0, cv::Rect(900, 900, 5, 5)}).empty());
}

TEST(CScaleSaliency, TakesTheGreyOfColourPictures) {
    cv::Mat colour;
    cv::merge(std::vector<cv::Mat>{texture(60, 50, 17), texture(60, 50, 18), texture(60, 50, 19)},
              colour);
    cv::Mat grey;
    cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
    const CScaleSaliency detector(smallScales());
    const auto expected = detector.detect(grey);
    ASSERT_FALSE(expected.empty());
    expectIdentical(detector.detect(colour), expected);
    cv::cvtColor(colour, colour, cv::COLOR_BGR2BGRA);
    expectIdentical(detector.detect(colour), expected);
}

TEST(CScaleSaliency, NamesAnInstructionSetThatIsNotThere) {
    TScaleSaliencyOptions options;
    for (const auto simd : {ESimd::neon, ESimd::avx512, ESimd::sse4}) {
        options.simd = simd;
        if (!hasSimd(simd)) {
            EXPECT_THROW(CScaleSaliency{options}, std::invalid_argument);
        }
    }
    EXPECT_FALSE(hasSimd(ESimd::neon) && hasSimd(ESimd::sse4));
}

TEST(CScaleSaliency, GivesTheSameDigitsForAnyNumberOfThreads) {
    const cv::Mat picture = texture(230, 190, 9);
    auto options = TScaleSaliencyOptions();
    const auto one = CScaleSaliency(options).detect(picture, {0.5});
    ASSERT_FALSE(one.empty());
    options.threads = 3;
    expectIdentical(CScaleSaliency(options).detect(picture, {0.5}), one);
}

TEST(CScaleSaliency, ReadsPartOfALargerPictureAsThatPart) {
    const cv::Mat whole = texture(90, 80, 10);
    const cv::Rect part(7, 9, 60, 50);
    const CScaleSaliency detector(smallScales());
    const auto expected = detector.detect(whole(part).clone());
    ASSERT_FALSE(expected.empty());
    expectIdentical(detector.detect(whole(part)), expected);
}

TEST(CScaleSaliency, FindsADotAtItsCentreWithTheEntropyCountedByHand) {
    // White disc of radius 5 (81 pixels) on black. About its centre H rises from 0 at s = 5 until
    // the areas are equal, N = 162: N(7) = 149 and N(8) = 197 give p = 81/149 and 81/197.
    cv::Mat picture(41, 41, CV_8UC1, cv::Scalar(0));
    for (int j = -5; j <= 5; ++j)
        for (int i = -5; i <= 5; ++i)
            if (i * i + j * j <= 25) picture.at<std::uint8_t>(20 + j, 20 + i) = 255;
    auto options = smallScales();
    options.scaleMax = 20;
    const auto peaks = CScaleSaliency(options).detect(picture);
    ASSERT_EQ(peaks.size(), 1u);
    EXPECT_EQ(std::make_tuple(peaks[0].x, peaks[0].y, peaks[0].s), std::make_tuple(20, 20, 7));
    const double p = 81.0 / 149;
    EXPECT_NEAR(peaks[0].H, -p * std::log(p) - (1 - p) * std::log(1 - p), 1e-12);
    // N(6) = 113. D(6) = 2 (1 - 81/113), D(7) = 2 (81/113 - 81/149), D(8) = 2 (81/149 - 81/197);
    // D(3) = D(4) = D(5) = 0, so smoothing makes D(4) = 0, D(5) = D(6)/3 and so on.
    const double d6 = 2 * (1 - 81.0 / 113);
    const double d7 = 2 * (81.0 / 113 - p);
    const double d8 = 2 * (p - 81.0 / 197);
    const double smooth6 = (d6 / 3 + d6 + d7) / 3;
    EXPECT_NEAR(peaks[0].W, 49.0 / 13 * (smooth6 + d7 + d8) / 3, 1e-12);
    EXPECT_DOUBLE_EQ(peaks[0].Y, peaks[0].H * peaks[0].W);
}

TEST(CScaleSaliency, FindsNothingInPicturesSmallerThanItsWindow) {
    const CScaleSaliency detector;
    EXPECT_TRUE(detector.detect(cv::Mat()).empty());
    EXPECT_TRUE(detector.detect(texture(1, 1, 11)).empty());
    EXPECT_TRUE(detector.detect(texture(66, 300, 12)).empty());
    EXPECT_TRUE(detector.detect(texture(300, 66, 13)).empty());
}

TEST(CScaleSaliency, FindsNothingInAPictureOfOneGrey) {
    auto options = smallScales();
    const cv::Mat grey(60, 60, CV_8UC1, cv::Scalar(77));
    EXPECT_TRUE(CScaleSaliency(options).detect(grey).empty());
    options.stretch = true;
    EXPECT_TRUE(CScaleSaliency(options).detect(grey).empty());
}

TEST(CScaleSaliency, RefusesPicturesThatAreNotOfEightBits) {
    const CScaleSaliency detector;
    for (const int type : {CV_8UC2, CV_8SC1, CV_16UC1, CV_16UC3, CV_32FC1, CV_64FC1})
        EXPECT_THROW(detector.detect(cv::Mat(80, 80, type, cv::Scalar::all(0))),
                     std::invalid_argument);
    try {
        detector.detect(cv::Mat(80, 80, CV_16UC1, cv::Scalar(0)));
    } catch (const std::invalid_argument& e) {
        EXPECT_NE(std::string(e.what()).find("CV_16UC1"), std::string::npos) << e.what();
    }
}

TEST(CScaleSaliency, RefusesAThresholdThatIsNotANumber) {
    EXPECT_THROW(
        CScaleSaliency().detect(texture(80, 80, 14), {std::numeric_limits<double>::quiet_NaN()}),
        std::invalid_argument);
}

TEST(CScaleSaliency, RefusesScalesBetweenWhichThereIsNone) {
    TScaleSaliencyOptions options;
    options.scaleMin = 32;
    EXPECT_THROW(CScaleSaliency{options}, std::invalid_argument);
}

TEST(CScaleSaliency, EitherRefusesSettingsAndPicturesOrFindsPeaksInside) {
    cv::RNG random(77);
    std::size_t refused = 0;
    const auto wild = [&random](int low, int high) {
        const int extremes[] = {-1, 0, std::numeric_limits<int>::min(),
                                std::numeric_limits<int>::max()};
        return random.uniform(0, 12) == 0 ? extremes[random.uniform(0, 4)]
                                          : random.uniform(low, high);
    };
    for (int i = 0; i < 1500; ++i) {
        TScaleSaliencyOptions options;
        options.scaleMin = wild(-2, 20);
        options.scaleMax = wild(0, 28);
        options.bins = wild(0, 260);
        options.threads = wild(0, 3);
        options.simd = static_cast<ESimd>(random.uniform(0, 8));
        const int types[] = {CV_8UC1, CV_8UC1, CV_8UC1, CV_8UC3, CV_16UC1, CV_32FC1};
        cv::Mat picture(random.uniform(0, 90), random.uniform(0, 90), types[random.uniform(0, 6)]);
        if (!picture.empty()) random.fill(picture, cv::RNG::UNIFORM, 0, 256);
        const cv::Rect part(random.uniform(-50, 99), random.uniform(-50, 99),
                            random.uniform(-9, 99), 40);
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const double thresholds[] = {-1, 0, 1.3, 1e300, std::numeric_limits<double>::infinity(),
                                     nan};
        const double yMin = thresholds[random.uniform(0, 6)];
        try {
            const auto found = CScaleSaliency(options).detect(
                picture, {yMin, std::size_t(random.uniform(0, 3)), part});
            for (const auto& peak : found) {
                ASSERT_GE(peak.x - options.scaleMax, 0) << i;
                ASSERT_GE(peak.y - options.scaleMax, 0) << i;
                ASSERT_LT(peak.x + options.scaleMax, picture.cols) << i;
                ASSERT_LT(peak.y + options.scaleMax, picture.rows) << i;
                ASSERT_GE(peak.Y, yMin) << i;
            }
        } catch (const std::invalid_argument&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 300u);
    EXPECT_LT(refused, 1400u);
}

}  // namespace
}  // namespace salma::saliency
