// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/appearance/CPatchMatcher.h>

#include <opencv2/imgcodecs.hpp>
#include <random>

#include "CPlanePictures.h"

namespace salma::bench {
namespace {

double aspectOf(const Corners& rectangle) {
    return (rectangle[1].x - rectangle[0].x) / (rectangle[3].y - rectangle[0].y);
}

/// Log ratio of picture 1 and picture k + 1, their corners wrong by `sigma` pixels.
double ratioOf(const CPlanePictures& set, std::size_t k, double sigma) {
    std::mt19937 random(static_cast<std::uint32_t>(k));
    std::normal_distribution<double> n;
    const auto moved = [&](Corners corners) {
        for (auto& c : corners) {
            c.x += sigma * n(random);
            c.y += sigma * n(random);
        }
        return corners;
    };
    const auto rectangle = set.common(k);
    const double aspect = aspectOf(rectangle);
    const auto a = patchOf(set.picture(0), moved(rectangle), aspect);
    const auto b = patchOf(set.picture(k), moved(set.inPicture(rectangle, k)), aspect);
    EXPECT_TRUE(a && b);
    return a && b ? appearance::CPatchMatcher().match(*a, *b).logLikelihoodRatio : -10;
}

TEST(RealPictures, OfThreePlanesAreRecognisedThroughTheirTrueMaps) {
    SALMA_NEED_DATA(folder, "homography");
    for (const char* name : {"churchill", "graf", "boat"}) {
        const auto set = CPlanePictures::ofSet(folder + "/..", name);
        for (std::size_t k = 1; k < set.size(); ++k)
            EXPECT_GT(ratioOf(set, k, 0), 1) << name << " 1-" << k + 1;
    }
}

TEST(RealPictures, OfTheMuralAreRecognisedThroughFourCornersWithNoise) {
    SALMA_NEED_DATA(folder, "homography");
    const auto set = CPlanePictures::ofSet(folder + "/..", "churchill");
    for (std::size_t k = 1; k < set.size(); ++k)
        for (const double sigma : {1.0, 2.0}) EXPECT_GT(ratioOf(set, k, sigma), 2.3) << k + 1;
}

TEST(RealPictures, OfOtherThingsAreNotTakenForTheMural) {
    SALMA_NEED_DATA(folder, "homography");
    SALMA_NEED_DATA(corridor, "corridor_images");
    const auto set = CPlanePictures::ofSet(folder + "/..", "churchill");
    const auto rectangle = set.common(1);
    const auto mural = patchOf(set.picture(0), rectangle, aspectOf(rectangle));
    ASSERT_TRUE(mural);
    std::vector<cv::Mat> others;
    for (const char* name : {"graf", "boat"}) {
        const auto other = CPlanePictures::ofSet(folder + "/..", name);
        for (std::size_t k = 0; k < other.size(); ++k) others.push_back(other.picture(k));
    }
    for (int k = 1; k <= 42; k += 6)
        others.push_back(
            cv::imread(corridor + "/" + std::to_string(k) + ".jpg", cv::IMREAD_GRAYSCALE));
    for (const auto& other : others) {
        const auto patch = patchOf(other, whole(other), aspectOf(rectangle));
        ASSERT_TRUE(patch);
        EXPECT_LE(appearance::CPatchMatcher().match(*mural, *patch).logLikelihoodRatio, 0);
    }
}

}  // namespace
}  // namespace salma::bench
