// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/appearance/CPatchDescriptor.h>
#include <salma/appearance/CPatchMatcher.h>

#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <stdexcept>

#include "wallRenderer.h"

namespace salma::appearance {
namespace {

using observations::TKeypoint;
using observations::TPatch;

/// Patch with random keypoints on 1 m x 1 m.
TPatch randomPatch(std::uint32_t seed, std::size_t count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    TPatch patch;
    for (std::size_t i = 0; i < count; ++i) {
        TKeypoint k{unit(random) - 0.5, unit(random) - 0.5, 0.05, 6 * unit(random) - 3, {}};
        for (auto& byte : k.descriptor) byte = static_cast<std::uint8_t>(random() % 120);
        patch.keypoints.push_back(k);
    }
    return patch;
}

/// The same patch scaled, turned and shifted.
TPatch moved(TPatch patch, const TSimilarity& s) {
    const double c = s.scale * std::cos(s.rotation);
    const double d = s.scale * std::sin(s.rotation);
    for (auto& k : patch.keypoints) {
        const double x = c * k.x - d * k.y + s.tx;
        k.y = d * k.x + c * k.y + s.ty;
        k.x = x;
        k.scale *= s.scale;
        k.angle += s.rotation;
    }
    return patch;
}

TEST(CPatchMatcher, FindsTheSimilarityBetweenTwoSightsOfOnePatch) {
    const TPatch a = randomPatch(1, 60);
    const auto match = CPatchMatcher().match(a, moved(a, {1.1, 0.1, 0.03, -0.02}));
    EXPECT_EQ(match.putative, 60U);
    EXPECT_EQ(match.consistent, 60U);
    EXPECT_DOUBLE_EQ(match.score, 1);
    EXPECT_GT(match.logLikelihoodRatio, 3);
    EXPECT_NEAR(match.similarity.scale, 1.1, 1e-9);
    EXPECT_NEAR(match.similarity.rotation, 0.1, 1e-9);
    EXPECT_NEAR(match.similarity.tx, 0.03, 1e-9);
    EXPECT_NEAR(match.similarity.ty, -0.02, 1e-9);
}

TEST(CPatchMatcher, CountsOutliersAgainstTheScore) {
    const TPatch a = randomPatch(1, 60);
    TPatch b = moved(a, {1, 0, 0.1, 0});
    for (std::size_t i = 0; i < 30; ++i) b.keypoints[i].x += 0.2 + 0.05 * static_cast<double>(i);
    const auto match = CPatchMatcher().match(a, b);
    EXPECT_EQ(match.putative, 60U);
    EXPECT_EQ(match.consistent, 30U);
    EXPECT_DOUBLE_EQ(match.score, 0.5);
    EXPECT_NEAR(match.similarity.tx, 0.1, 1e-9);
    for (const auto& pair : match.pairs) EXPECT_GE(pair.first, 30U);
}

TEST(CPatchMatcher, HoldsPatchesToBeMetricAndUpright) {
    const TPatch a = randomPatch(1, 60);
    EXPECT_EQ(CPatchMatcher().match(a, moved(a, {2, 0, 0, 0})).score, 0);
    EXPECT_EQ(CPatchMatcher().match(a, moved(a, {1, M_PI / 2, 0, 0})).score, 0);
}

TEST(CPatchMatcher, SpeaksAgainstADifferentPatchAndNotAtAllWithoutKeypoints) {
    const TPatch a = randomPatch(1, 60);
    const auto other = CPatchMatcher().match(a, randomPatch(2, 60));
    EXPECT_EQ(other.score, 0);
    EXPECT_LT(other.logLikelihoodRatio, -1);
    for (const std::size_t few : {0U, 3U}) {
        const auto nothing = CPatchMatcher().match(a, randomPatch(1, few));
        EXPECT_EQ(nothing.score, 0);
        EXPECT_EQ(nothing.logLikelihoodRatio, 0);
    }
    EXPECT_EQ(CPatchMatcher().match(TPatch(), TPatch()).logLikelihoodRatio, 0);
}

TEST(CPatchMatcher, IsTheSameBothWays) {
    const TPatch a = randomPatch(1, 50);
    TPatch b = moved(a, {1.05, -0.05, 0.02, 0.01});
    b.keypoints.resize(35);
    const auto ab = CPatchMatcher().match(a, b);
    const auto ba = CPatchMatcher().match(b, a);
    EXPECT_EQ(ab.consistent, ba.consistent);
    EXPECT_EQ(ab.score, ba.score);
    EXPECT_NEAR(ab.similarity.scale * ba.similarity.scale, 1, 1e-6);
}

TEST(CPatchMatcher, ReadsItsTableBetweenTheKnotsAndBelowTheDuplicateLimit) {
    TMatcherOptions options;
    options.scoreKnots = {0, 0.5, 1};
    options.logLrKnots = {-2, 0, 8};
    options.duplicateRate = 1e-9;
    const CPatchMatcher sure(options);
    EXPECT_NEAR(sure.logLikelihoodRatio(0.25), -1, 1e-6);
    EXPECT_NEAR(sure.logLikelihoodRatio(0.75), 4, 1e-6);
    EXPECT_NEAR(sure.logLikelihoodRatio(7), 8, 1e-5);
    options.duplicateRate = 0.1;
    const CPatchMatcher doubtful(options);
    double last = -10;
    for (double s = 0; s <= 1; s += 0.05) {
        const double now = doubtful.logLikelihoodRatio(s);
        EXPECT_GE(now, last);
        EXPECT_LE(now, std::log(10));
        last = now;
    }
}

TEST(CPatchMatcher, RefusesATableThatIsNone) {
    const auto refused = [](std::vector<double> x, std::vector<double> y) {
        TMatcherOptions options;
        options.scoreKnots = std::move(x);
        options.logLrKnots = std::move(y);
        EXPECT_THROW(CPatchMatcher{options}, std::invalid_argument);
    };
    refused({0, 1}, {0});
    refused({0.1, 1}, {0, 1});
    refused({0, 0.5, 0.5, 1}, {0, 1, 2, 3});
    refused({0, 1}, {1, 0});
    refused({0, 1}, {std::nan(""), 0});
}

/// One random look at a poster of 0.8 m height; nothing if it is refused.
std::optional<TPatch> look(const cv::Mat& poster, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const double width = 0.8 * poster.cols / poster.rows;
    const double distance = 3.5 + 2.5 * unit(random);
    const double incidence = 65 * M_PI / 180 * unit(random);
    const double alpha = unit(random);
    const double u = distance * std::sin(incidence);
    const auto wall = test::wallLine(distance * std::cos(incidence), alpha);
    const CWallView view(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, alpha - incidence, 0),
                         wall);
    const TWallRectangle place{u - width / 2, 0.1, u + width / 2, 0.9};
    const cv::Mat picture =
        test::renderPoster(view, poster, place, {0.7 + 0.7 * unit(random), 4, 0.9}, random);
    // the wall and the border are known with errors
    const CWallView seen(
        view.camera(), view.cameraPose(),
        test::wallLine(view.wall().rho + 0.02 * unit(random), alpha + 0.03 * unit(random)));
    const auto a = seen.toWall(*view.toPixel(place.u0, 0.1));
    const auto b = seen.toWall(*view.toPixel(place.u1, 0.9));
    const TWallRectangle cut{a->x + 0.03 * unit(random), a->y, b->x, b->y};
    auto patch = CRectifier().rectify(picture, seen, cut).patch;
    if (patch) patch->keypoints = CPatchDescriptor().describe(*patch);
    return patch;
}

TEST(CPatchMatcher, TellsPaintingsApartFromOneToSixMetresAndUpTo65Degrees) {
    std::mt19937 random(21);
    std::vector<std::vector<TPatch>> sights;
    for (const char* name : {"MonaLisa", "GreatWave", "Arcimboldo_Spring", "KazusaSeaRoute"}) {
        SALMA_NEED_DATA(file, std::string("posters/") + name + ".png");
        const cv::Mat poster = cv::imread(file, cv::IMREAD_GRAYSCALE);
        std::vector<TPatch> of;
        for (int i = 0; i < 20 && of.size() < 5; ++i)
            if (auto patch = look(poster, random)) of.push_back(std::move(*patch));
        ASSERT_EQ(of.size(), 5U) << name;
        sights.push_back(std::move(of));
    }
    const CPatchMatcher matcher;
    int same = 0, sameFound = 0, otherFound = 0;
    for (std::size_t p = 0; p < sights.size(); ++p)
        for (std::size_t q = p; q < sights.size(); ++q)
            for (std::size_t i = 0; i < 5; ++i)
                for (std::size_t j = p == q ? i + 1 : 0; j < 5; ++j) {
                    const auto match = matcher.match(sights[p][i], sights[q][j]);
                    same += p == q;
                    if (p == q) sameFound += match.logLikelihoodRatio > 1;
                    if (p != q) otherFound += match.logLikelihoodRatio > 0;
                }
    EXPECT_EQ(same, 40);
    EXPECT_GE(sameFound, 36);
    EXPECT_EQ(otherFound, 0);
}

}  // namespace
}  // namespace salma::appearance
