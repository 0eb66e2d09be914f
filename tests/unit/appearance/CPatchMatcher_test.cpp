// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/appearance/CPatchDescriptor.h>
#include <salma/appearance/CPatchMatcher.h>

#include <Eigen/Dense>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

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
    EXPECT_EQ(match.keypoints.size(), 60U);
    EXPECT_DOUBLE_EQ(match.score, 1);
    EXPECT_GT(match.logLikelihoodRatio, 0.9 * -std::log(TMatcherOptions().duplicateRate));
    EXPECT_NEAR(match.relative->similarity.scale, 1.1, 1e-9);
    EXPECT_NEAR(match.relative->similarity.rotation, 0.1, 1e-9);
    EXPECT_NEAR(match.relative->similarity.tx, 0.03, 1e-9);
    EXPECT_NEAR(match.relative->similarity.ty, -0.02, 1e-9);
}

TEST(CPatchMatcher, CountsOutliersAgainstTheScore) {
    const TPatch a = randomPatch(1, 60);
    TPatch b = moved(a, {1, 0, 0.1, 0});
    for (std::size_t i = 0; i < 30; ++i) b.keypoints[i].x += 0.2 + 0.05 * static_cast<double>(i);
    const auto match = CPatchMatcher().match(a, b);
    EXPECT_EQ(match.putative, 60U);
    EXPECT_EQ(match.keypoints.size(), 30U);
    EXPECT_DOUBLE_EQ(match.score, 0.5);
    EXPECT_NEAR(match.relative->similarity.tx, 0.1, 1e-9);
    for (const auto& pair : match.keypoints) EXPECT_GE(pair.first, 30U);
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
    EXPECT_EQ(ab.keypoints.size(), ba.keypoints.size());
    EXPECT_EQ(ab.score, ba.score);
    EXPECT_NEAR(ab.relative->similarity.scale * ba.relative->similarity.scale, 1, 1e-6);
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

/// Noise of several sizes: what a painting is to a detector.
cv::Mat painted(int rows, int cols, std::uint32_t seed) {
    cv::Mat sum = cv::Mat::zeros(rows, cols, CV_32F);
    cv::RNG random(seed);
    for (const int cell : {6, 20, 50}) {
        cv::Mat coarse(rows / cell + 2, cols / cell + 2, CV_32F), fine;
        random.fill(coarse, cv::RNG::UNIFORM, -50, 50);
        cv::resize(coarse, fine, {cols, rows}, 0, 0, cv::INTER_CUBIC);
        sum += fine;
    }
    cv::Mat grey;
    sum.convertTo(grey, CV_8U, 1, 127);
    return grey;
}

/// A patch of 0.6 m x 0.8 m of a painted wall, cut `dx` right and `dy` above the middle, with
/// regions at fixed places of the wall. The robot is at `view` from straight ahead.
TPatch withRegions(std::uint32_t seed, double dx, double dy, double view = 0) {
    constexpr double kResolution = 200;
    const cv::Mat wall = painted(240, 200, seed);
    TPatch patch;
    patch.width = 0.6;
    patch.height = 0.8;
    patch.pixelsPerMetre = kResolution;
    const cv::Rect cut(40 + static_cast<int>(std::lround(dx * kResolution)),
                       40 - static_cast<int>(std::lround(dy * kResolution)), 120, 160);
    patch.picture = mrpt::img::CImage(wall(cut), mrpt::img::DEEP_COPY);
    patch.pose.mean =
        mrpt::poses::CPose3D(2 * std::cos(view), -2 * std::sin(view), 1, -M_PI_2, 0, M_PI_2);
    patch.pose.cov.setIdentity();
    patch.pose.cov *= 1e-5;
    patch.incidence = std::abs(view);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 25; ++i) {
        const double x = 0.28 * unit(random) - dx, y = 0.38 * unit(random) - dy;
        const double s = 0.05 + 0.03 * unit(random);
        patch.regions.push_back({x, y, s, 2, 1, 2.0 - 0.01 * i});
    }
    return patch;
}

TEST(CPatchMatcher, PairsTheRegionsOfOneWallAfterTheirCommonShift) {
    const auto match = CPatchMatcher().match(withRegions(3, 0, 0), withRegions(3, 0.03, -0.02));
    EXPECT_DOUBLE_EQ(match.regionScore, 1);
    EXPECT_TRUE(match.regionsAgree);
    for (const auto& [i, j] : match.regions) EXPECT_EQ(i, j);
    ASSERT_TRUE(match.relative) << "from the regions, without a keypoint";
    EXPECT_NEAR(match.relative->similarity.tx, -0.03, 1e-9);
    EXPECT_NEAR(match.relative->similarity.ty, 0.02, 1e-9);
    EXPECT_NEAR(match.relative->similarity.scale, 1, 1e-9);
    EXPECT_EQ(match.logLikelihoodRatio, 0) << "without keypoints nothing is said";
}

TEST(CPatchMatcher, UsesEachRegionOnce) {
    TPatch many = withRegions(3, 0, 0);
    const auto first = many.regions[0];
    many.regions.assign(25, first);
    const auto match = CPatchMatcher().match(many, withRegions(3, 0, 0));
    std::set<std::size_t> a, b;
    for (const auto& [i, j] : match.regions) {
        EXPECT_TRUE(a.insert(i).second);
        EXPECT_TRUE(b.insert(j).second);
    }
    EXPECT_LT(match.regionScore, 0.3);
}

TEST(CPatchMatcher, MatchesRegionsOfOtherPaintingsByChanceOnly) {
    const CPatchMatcher matcher;
    double sum = 0;
    int n = 0;
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j, ++n) {
            const auto match = matcher.match(withRegions(i, 0, 0), withRegions(j, 0, 0));
            EXPECT_FALSE(match.regionsAgree) << i << ", " << j;
            sum += match.regionScore;
        }
    EXPECT_LT(sum / n, 0.05);
}

TEST(CPatchMatcher, DemandsLessOfViewsFromFarApart) {
    TPatch a = withRegions(3, 0, 0);
    TPatch b = withRegions(3, 0, 0), aside = withRegions(3, 0, 0, mrpt::DEG2RAD(60.0));
    // Of the ten regions that count in each patch, those in b are moved away one by one.
    for (std::size_t i = 0; i < 10; ++i) {
        b.regions[i].s = aside.regions[i].s = 0.3;
        const auto near = CPatchMatcher().match(a, b), far = CPatchMatcher().match(a, aside);
        EXPECT_NEAR(near.viewDifference, 0, 1e-9);
        EXPECT_NEAR(far.viewDifference, mrpt::DEG2RAD(60.0), 1e-9);
        EXPECT_EQ(near.regionsAgree, near.regionScore >= 0.5);
        EXPECT_EQ(far.regionsAgree, far.regionScore >= 0.5 - 0.1 * 60 / 130);
    }
}

TEST(CPatchMatcher, WidensTheGateByTheCovarianceOfThePose) {
    const TPatch a = withRegions(3, 0, 0, mrpt::DEG2RAD(60.0));
    TPatch b = a;
    for (auto& r : b.regions) r.x *= 1.3;  // as a wall angle wrong by 5 deg makes it
    const double sure = CPatchMatcher().match(a, b).regionScore;
    b.pose.cov(3, 3) = mrpt::square(mrpt::DEG2RAD(5.0));
    const double unsure = CPatchMatcher().match(a, b).regionScore;
    EXPECT_GT(unsure, sure + 0.2);
}

TEST(CPatchMatcher, SaysNothingByRegionsThatAreNone) {
    const TPatch a = withRegions(3, 0, 0);
    TPatch lost = a, odd = a, bare = a, other = a;
    lost.pose.mean = mrpt::poses::CPose3D(std::nan(""), 0, 1, 0, 0, M_PI_2);
    odd.regions[4].s = 0;
    bare.picture = mrpt::img::CImage();
    other.width = 0.2;  // an extent gone wrong
    for (const TPatch* b : {&lost, &odd, &bare, &other}) {
        const auto match = CPatchMatcher().match(a, *b);
        EXPECT_EQ(match.regionScore, 0);
        EXPECT_FALSE(match.regionsAgree);
        EXPECT_FALSE(match.relative);
    }
}

/// With regions and keypoints, so that every part of the matcher has something to say.
TPatch fullPatch() {
    TPatch patch = withRegions(3, 0, 0);
    patch.keypoints = randomPatch(3, 40).keypoints;
    patch.texture.assign(140, 1 / 140.0F);
    return patch;
}

TEST(CPatchMatcher, NeverSaysAThingThatIsNoNumber) {
    const double nan = std::nan(""), infinite = 1e300 * 1e300;
    const TPatch good = fullPatch();
    std::vector<TPatch> bad(12, good);
    bad[0].pose.mean = mrpt::poses::CPose3D(nan, 0, 1, 0, 0, M_PI_2);
    bad[1].pose.mean = mrpt::poses::CPose3D(2, 0, 1, nan, 0, M_PI_2);
    bad[2].pose.cov(0, 3) = nan;
    bad[3].pose.cov(5, 5) = infinite;
    for (auto& k : bad[4].keypoints) k.x = nan;
    for (auto& k : bad[5].keypoints) k.scale = 0;
    for (auto& k : bad[6].keypoints) k.angle = infinite;
    for (auto& r : bad[7].regions) r.x = nan;
    bad[8].width = bad[8].height = 0;
    bad[9].width = nan;
    bad[10].texture.assign(140, static_cast<float>(nan));
    bad[11].texture.assign(7, 0.1F);  // of another version
    bad.push_back(TPatch());
    for (std::size_t i = 0; i < bad.size(); ++i)
        for (const auto& [a, b] :
             {std::pair(good, bad[i]), std::pair(bad[i], good), std::pair(bad[i], bad[i])}) {
            const auto match = CPatchMatcher().match(a, b);
            EXPECT_TRUE(std::isfinite(match.score + match.logLikelihoodRatio + match.keypointScore +
                                      match.regionScore + match.viewDifference))
                << i;
            EXPECT_TRUE(!match.textureDistance || std::isfinite(*match.textureDistance)) << i;
            EXPECT_TRUE(!match.relative || match.relative->covariance.allFinite()) << i;
            if (i < 4) {
                EXPECT_EQ(match.logLikelihoodRatio, 0) << i << " says nothing";
                EXPECT_FALSE(match.relative) << i;
            }
        }
}

TEST(CPatchMatcher, DoesNotTakeALayoutForAPrint) {
    // the regions of one print, the keypoints of two
    TPatch a = fullPatch(), b = fullPatch();
    b.keypoints = randomPatch(4, 40).keypoints;
    const auto match = CPatchMatcher().match(a, b);
    EXPECT_GT(match.regionScore, 0.9);
    EXPECT_EQ(match.keypointScore, 0);
    EXPECT_LT(match.logLikelihoodRatio, -1);
    b.keypoints.resize(12);  // too few to contradict
    EXPECT_GT(CPatchMatcher().match(a, b).logLikelihoodRatio, 1);
}

TEST(CPatchMatcher, HoldsHalfOfTheKeypointsForEnoughBesideAsManyRegions) {
    const auto enough = [](std::size_t keypoints, std::size_t regions) {
        TPatch patch = randomPatch(1, keypoints);
        patch.regions.resize(regions);
        return saysEnough(patch, 12);
    };
    EXPECT_TRUE(enough(12, 0));
    EXPECT_FALSE(enough(11, 11));
    EXPECT_TRUE(enough(11, 12));
    EXPECT_TRUE(enough(6, 12));
    EXPECT_FALSE(enough(5, 100));
    EXPECT_TRUE(saysEnough(TPatch(), 0));
}

/// NEES of (tx, ty, rotation, log scale).
double neesOf(const TRelativePose& found, const TSimilarity& truth) {
    const Eigen::Vector4d error(found.similarity.tx - truth.tx, found.similarity.ty - truth.ty,
                                found.similarity.rotation - truth.rotation,
                                std::log(found.similarity.scale / truth.scale));
    return error.dot(found.covariance.inverse() * error);
}

TEST(CPatchMatcher, StatesTheCovarianceThatTheRelativePoseHas) {
    const CPatchMatcher matcher;
    const TSimilarity truth{1.05, 0.08, 0.04, -0.03};
    std::mt19937 random(8);
    std::normal_distribution<double> n(0, 0.004);
    constexpr int kRuns = 400;
    double mean = 0;
    for (int run = 0; run < kRuns; ++run) {
        const TPatch a = randomPatch(static_cast<std::uint32_t>(run), 60);
        TPatch b = moved(a, truth);
        for (auto& k : b.keypoints) {
            k.x += n(random);
            k.y += n(random);
        }
        const auto match = matcher.match(a, b);
        ASSERT_TRUE(match.relative);
        mean += neesOf(*match.relative, truth) / kRuns;
    }
    // chi-square(4) over 400 runs: 95 % within 4 +- 0.28; the noise's size is estimated too, from
    // 116 degrees of freedom, which raises the mean to 4 * 116 / 114.
    EXPECT_NEAR(mean, 4 * 116.0 / 114, 0.28);
}

/// Keypoints of a wall 60 deg to one side, as seen when line, camera and lean are wrong, with the
/// rectifier's own word on how far; `at` is the true middle of the patch on the wall.
TPatch wronglyRectified(const TPatch& wall,
                        double alpha,
                        const mrpt::math::TPoint2D& at,
                        std::mt19937& random) {
    std::normal_distribution<double> n;
    const TRectificationOptions options;
    auto line = test::wallLine(2.5 * std::cos(alpha), alpha);
    line.covariance << 2.5e-5, 0, 0, mrpt::square(mrpt::DEG2RAD(0.5));
    const double middle = 2.5 * std::sin(alpha);
    const CWallView truth(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, 0, 0), line);
    line.rho += std::hypot(0.005, options.wallSigma) * n(random);
    line.alpha += mrpt::DEG2RAD(0.5) * n(random);
    const double shift = options.extrinsicsSigmaXyz, turn = options.extrinsicsSigma;
    const mrpt::poses::CPose3D camera = mrpt::poses::CPose3D(shift * n(random), shift * n(random),
                                                             0.5 + shift * n(random), 0, 0, 0) +
                                        mrpt::poses::CPose3D(0, 0, 0, turn * n(random), 0, 0) +
                                        mrpt::poses::CPose3D(0, 0, 0, -M_PI_2, 0, -M_PI_2);
    const CWallView seen(test::pannedCamera(), camera, line);
    const auto believed = [&](double x, double y) {
        return *seen.toWall(*truth.toPixel(middle + x, 0.5 + y));
    };
    const auto centre = believed(at.x, at.y);
    TPatch patch = wall;
    patch.pose = CRectifier(options).pose(seen, centre.x, centre.y);
    const double lean = options.tiltSigma * n(random);
    for (auto& k : patch.keypoints) {
        const auto p = believed(k.x, k.y);
        const double x = p.x - centre.x, y = p.y - centre.y;
        k.x = x - lean * y + 0.002 * n(random);
        k.y = y + lean * x + 0.002 * n(random);
    }
    return patch;
}

TEST(CPatchMatcher,
     StatesACovarianceOfTheRelativePoseThatIsNotTooBoldWhenBothPatchesAreWronglyRectified) {
    const CPatchMatcher matcher;
    std::mt19937 random(9);
    constexpr int kRuns = 400;
    for (const double alpha : {0.3, 0.8, 1.05}) {  // from 17, 46 and 60 deg to either side
        double mean = 0;
        for (int run = 0; run < kRuns; ++run) {
            TPatch wall = randomPatch(static_cast<std::uint32_t>(run), 60);
            for (auto& k : wall.keypoints) k.x *= 0.5, k.y *= 0.5;
            const mrpt::math::TPoint2D atA(0.02, -0.01), atB(-0.01, 0.02);
            const TPatch a = wronglyRectified(wall, alpha, atA, random);
            const TPatch b = wronglyRectified(wall, -alpha, atB, random);
            const auto match = matcher.match(a, b);
            ASSERT_TRUE(match.relative);
            mean += neesOf(*match.relative, {1, 0, atA.x - atB.x, atA.y - atB.y}) / kRuns;
        }
        RecordProperty("nees_" + std::to_string(static_cast<int>(100 * alpha)),
                       std::to_string(mean));
        // Not bolder than the 95 % interval of 4 allows. Cautious it is: the poses' covariances do
        // not tell a wrong place of the camera, which stretches nothing along the wall, from a
        // wrong wall.
        EXPECT_LT(mean, 4 + 0.28) << alpha;
        EXPECT_GT(mean, 3) << alpha;
    }
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
