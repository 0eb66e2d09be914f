// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/appearance/CPatchMatcher.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "CDescriber.h"
#include "prints.h"

namespace salma::bench {
namespace {

constexpr std::uint32_t kViews = 3;

/// Views of a print of 0.6 m height.
std::vector<TPosterView> viewsOf(const cv::Mat& print, const char* wall, std::uint32_t seed) {
    const test::CTemporaryFolder folder;
    const std::string file = (folder / "print.png").string();
    EXPECT_TRUE(cv::imwrite(file, print));
    const CPosterViews views(file, wall, 0.6, seed);
    std::vector<TPosterView> out;
    for (std::uint32_t i = 0; i < kViews; ++i) out.push_back(views.view(i));
    return out;
}

cv::Mat painting(const char* name) {
    return cv::imread(std::string(SALMA_SOURCE_DIR) + "/share/textures/" + name + ".jpg");
}

/// Log ratios of all views of one print and all of another.
std::vector<double> ratios(const std::vector<TPosterView>& a, const std::vector<TPosterView>& b) {
    const CDescriber describer;
    const appearance::CPatchMatcher matcher;
    std::vector<double> out;
    for (const auto& one : a)
        for (const auto& other : b) {
            const auto p = describer.patchOf(one), q = describer.patchOf(other);
            EXPECT_TRUE(p && q);
            if (p && q) out.push_back(matcher.match(*p, *q).logLikelihoodRatio);
        }
    return out;
}

TEST(NearDuplicates, ASecondPrintScoresAsTheSameOneButNoHigherThanTheDuplicateRateAllows) {
    const cv::Mat print = painting("GreatWave");
    const double limit = -std::log(appearance::TMatcherOptions().duplicateRate);
    for (const double ratio : ratios(viewsOf(print, "brick", 1), viewsOf(print, "wood", 2))) {
        EXPECT_GT(ratio, 0);
        EXPECT_LE(ratio, limit);
    }
}

TEST(NearDuplicates, MirroredAndUpsideDownPrintsAreOthers) {
    const cv::Mat print = painting("GreatWave");
    const auto upright = viewsOf(print, "brick", 1);
    for (const int code : {1, -1}) {
        cv::Mat turned;
        cv::flip(print, turned, code);
        for (const double ratio : ratios(upright, viewsOf(turned, "brick", 3)))
            EXPECT_LT(ratio, -1) << (code == 1 ? "mirrored" : "upside down");
    }
}

TEST(NearDuplicates, APrintIsKnownTwoStopsDarker) {
    const auto bright = viewsOf(painting("GreatWave"), "brick", 1);
    auto dark = bright;
    for (auto& view : dark) view.grey = view.grey / 4;
    for (const double ratio : ratios(bright, dark)) EXPECT_GT(ratio, 0);
}

TEST(NearDuplicates, APrintOfWhichSomebodyHidesAFifthIsKnown) {
    const auto whole = viewsOf(painting("GreatWave"), "brick", 1);
    auto hidden = viewsOf(painting("GreatWave"), "brick", 4);
    for (auto& view : hidden) hide(view, 0.2);
    for (const double ratio : ratios(whole, hidden)) EXPECT_GT(ratio, 0);
}

}  // namespace
}  // namespace salma::bench
