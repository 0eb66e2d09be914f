// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/CRepeatability.h>
#include <salma/saliency/ellipseGeometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <random>
#include <set>
#include <stdexcept>

namespace salma::saliency {
namespace {

const cv::Size kPicture(640, 480);

TEllipse disc(double u, double v, double radius) {
    return {u, v, 1 / (radius * radius), 0, 1 / (radius * radius)};
}

/// Ellipses of all directions, half axes from 3 to 40 px.
TRegionView randomView(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    TRegionView view{{}, kPicture};
    for (std::size_t i = 0; i < count; ++i) {
        const double a = std::pow(3 + 37 * unit(random), -2);
        const double c = std::pow(3 + 37 * unit(random), -2);
        const double b = (1.6 * unit(random) - 0.8) * std::sqrt(a * c);
        view.regions.push_back(
            {kPicture.width * unit(random), kPicture.height * unit(random), a, b, c});
    }
    return view;
}

/// Discs that lie whole within the picture.
TRegionView randomDiscs(std::size_t count, double least, double most, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    TRegionView view{{}, kPicture};
    for (std::size_t i = 0; i < count; ++i) {
        const double r = least + (most - least) * unit(random);
        const double u = r + (kPicture.width - 1 - 2 * r) * unit(random);
        view.regions.push_back(disc(u, r + (kPicture.height - 1 - 2 * r) * unit(random), r));
    }
    return view;
}

/// What a perfect detector finds in a second picture.
TRegionView imageOf(const TRegionView& view, const cv::Matx33d& H, const cv::Size& picture) {
    TRegionView image{{}, picture};
    for (const auto& region : view.regions) image.regions.push_back(*mapped(H, region));
    return image;
}

std::vector<cv::KeyPoint> keypoints(const TRegionView& view) {
    std::vector<cv::KeyPoint> points;
    for (const auto& e : view.regions)
        points.emplace_back(static_cast<float>(e.u), static_cast<float>(e.v),
                            static_cast<float>(2 * e.radius()));
    return points;
}

/// The best first matching of all pairs, without any short cut.
std::set<std::pair<std::size_t, std::size_t>> reference(const TRegionView& first,
                                                        const TRegionView& second,
                                                        double maxError) {
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < first.regions.size(); ++i)
        for (std::size_t j = 0; j < second.regions.size(); ++j) {
            TEllipse a = first.regions[i];
            TEllipse b = second.regions[j];
            const double radius = a.radius();
            if (std::hypot(a.u - b.u, a.v - b.v) >= 4 * radius) continue;
            for (TEllipse* e : {&a, &b})
                for (double* shape : {&e->a, &e->b, &e->c}) *shape *= radius * radius / 900;
            if (const double error = overlapError(a, b); error < maxError)
                pairs.emplace_back(error, i, j);
        }
    std::sort(pairs.begin(), pairs.end());
    std::set<std::size_t> usedFirst, usedSecond;
    std::set<std::pair<std::size_t, std::size_t>> taken;
    for (const auto& [error, i, j] : pairs)
        if (usedFirst.count(i) == 0 && usedSecond.count(j) == 0) {
            usedFirst.insert(i);
            usedSecond.insert(j);
            taken.emplace(i, j);
        }
    return taken;
}

cv::Matx33d shift(double x, double y) { return {1, 0, x, 0, 1, y, 0, 0, 1}; }

/// Those of a view that lie whole within the picture.
TRegionView whole(const TRegionView& view) {
    TRegionView kept{{}, view.picture};
    for (const auto& e : view.regions) {
        const cv::Size2d half = halfBox(e);
        if (e.u >= half.width && e.v >= half.height && e.u + half.width <= view.picture.width - 1 &&
            e.v + half.height <= view.picture.height - 1)
            kept.regions.push_back(e);
    }
    return kept;
}

TEST(CRepeatability, IsOneForAPictureAndItself) {
    const auto view = randomView(400, 1);
    const auto result = CRepeatability().compare(view, view, cv::Matx33d::eye());
    EXPECT_EQ(result.firstCommon, whole(view).regions.size());
    EXPECT_LT(result.firstCommon, 400u);  // some are cut by the border
    EXPECT_EQ(result.rate(), 1);
    for (const auto& pair : result.correspondences) {
        EXPECT_EQ(pair.first, pair.second);
        EXPECT_NEAR(pair.overlapError, 0, 1e-4);
    }
    EXPECT_EQ(result.nonRedundantCorrespondences, result.firstNonRedundant);
}

TEST(CRepeatability, IsOneUnderATurnAScaleAndAPerspective) {
    const auto view = randomView(400, 2);
    for (const cv::Matx33d& H :
         {cv::Matx33d(1.3, -0.8, 300, 0.8, 1.3, -90, 0, 0, 1),
          cv::Matx33d(0.4, 0.1, 60, -0.1, 0.4, 120, 0, 0, 1),
          cv::Matx33d(0.76, -0.3, 225, 0.33, 1.01, -77, 3.5e-4, -1.4e-5, 1)}) {
        const auto result = CRepeatability().compare(view, imageOf(view, H, {800, 640}), H);
        EXPECT_GT(result.correspondences.size(), 100u);
        EXPECT_EQ(result.firstCommon, result.secondCommon);
        EXPECT_EQ(result.rate(), 1);
    }
}

TEST(CRepeatability, DoesNotDependOnTheScaleOfTheMatrix) {
    const auto view = randomView(200, 3);
    const cv::Matx33d H(0.76, -0.3, 225, 0.33, 1.01, -77, 3.5e-4, -1.4e-5, 1);
    const auto image = imageOf(view, H, {800, 640});
    const auto expected = CRepeatability().compare(view, image, H);
    const auto negative = CRepeatability().compare(view, image, H * -0.01);
    EXPECT_EQ(negative.correspondences.size(), expected.correspondences.size());
}

TEST(CRepeatability, CountsOnlyWhatBothPicturesShowWhole) {
    // The second picture shows the right half of the first, and as much beyond.
    const TRegionView first{{disc(100, 200, 10),   // left of the second picture
                             disc(325, 200, 10),   // cut by its border
                             disc(400, 200, 10),   // in both
                             disc(630, 200, 15)},  // cut by the first's border
                            kPicture};
    const TRegionView second{{disc(80, 200, 10),    // in both
                              disc(200, 200, 10),   // in both, not found in the first
                              disc(500, 200, 10)},  // right of the first picture
                             kPicture};
    const auto result = CRepeatability().compare(first, second, shift(-320, 0));
    EXPECT_EQ(result.firstCommon, 1u);
    EXPECT_EQ(result.secondCommon, 2u);
    ASSERT_EQ(result.correspondences.size(), 1u);
    EXPECT_EQ(result.correspondences[0].first, 2u);
    EXPECT_EQ(result.correspondences[0].second, 0u);
    EXPECT_EQ(result.rate(), 1);  // by the smaller number
}

TEST(CRepeatability, IsZeroWhereNothingIsCommon) {
    const auto view = randomView(50, 4);
    EXPECT_EQ(CRepeatability().compare(view, view, shift(2000, 0)).rate(), 0);
    EXPECT_EQ(CRepeatability().compare(view, {{}, kPicture}, cv::Matx33d::eye()).rate(), 0);
    EXPECT_EQ(CRepeatability().compare({{}, {}}, {{}, {}}, cv::Matx33d::eye()).nonRedundantRate(),
              0);
}

TEST(CRepeatability, EnlargesRegionsButNotTheDistanceOfTheirCentres) {
    // Equal discs brought to 30 px: error 0.4 at a distance of 11.8 px.
    const auto corresponds = [](double radius, double distance) {
        const TRegionView first{{disc(300, 240, radius)}, kPicture};
        const TRegionView second{{disc(300 + distance, 240, radius)}, kPicture};
        return !CRepeatability().compare(first, second, cv::Matx33d::eye()).correspondences.empty();
    };
    for (const double radius : {3.0, 30.0, 100.0}) {
        EXPECT_TRUE(corresponds(radius, 11.7)) << radius;
        EXPECT_FALSE(corresponds(radius, 12.0)) << radius;
    }
    EXPECT_FALSE(corresponds(2.9, 11.7));  // four radii apart
}

TEST(CRepeatability, TakesThePublishedErrorOfTwoSizes) {
    // A disc within another of 1.29 times its radius has the error 1 - 1/1.29^2 = 0.399.
    const auto rate = [](double radius) {
        const TRegionView first{{disc(300, 240, 20)}, kPicture};
        const TRegionView second{{disc(300, 240, radius)}, kPicture};
        return CRepeatability().compare(first, second, cv::Matx33d::eye()).rate();
    };
    EXPECT_EQ(rate(20 * 1.288), 1);
    EXPECT_EQ(rate(20 * 1.292), 0);
    EXPECT_EQ(rate(20 / 1.288), 1);
    EXPECT_EQ(rate(20 / 1.292), 0);
}

TEST(CRepeatability, PairsEachRegionOnceAndTheBestFirst) {
    const TRegionView first{{disc(300, 240, 20), disc(302, 240, 20)}, kPicture};
    const TRegionView second{{disc(302, 240, 20), disc(305, 240, 20), disc(306, 240, 20)},
                             kPicture};
    const auto result = CRepeatability().compare(first, second, cv::Matx33d::eye());
    ASSERT_EQ(result.correspondences.size(), 2u);
    EXPECT_EQ(result.correspondences[0].first, 1u);
    EXPECT_EQ(result.correspondences[0].second, 0u);
    EXPECT_EQ(result.correspondences[1].first, 0u);
    EXPECT_EQ(result.correspondences[1].second, 1u);
}

TEST(CRepeatability, IsRaisedByCopiesOfRepeatedRegionsButItsNonRedundantFormIsNot) {
    // Of twenty regions in each picture ten are repeated, and lie apart.
    TRegionView first{{}, kPicture};
    TRegionView second{{}, kPicture};
    for (int i = 0; i < 20; ++i) {
        first.regions.push_back(disc(60 + 55 * (i % 10), 80 + 80 * (i / 10), 8));
        second.regions.push_back(disc(60 + 55 * (i % 10), 80 + 240 * (i / 10), 8));
    }
    const auto plain = CRepeatability().compare(first, second, cv::Matx33d::eye());
    EXPECT_EQ(plain.correspondences.size(), 10u);
    EXPECT_DOUBLE_EQ(plain.rate(), 0.5);
    EXPECT_NEAR(plain.nonRedundantRate(), 0.5, 1e-5);
    EXPECT_NEAR(plain.firstNonRedundant, 20, 1e-4);
    for (int i = 0; i < 10; ++i)
        for (int copy = 0; copy < 4; ++copy) {
            first.regions.push_back(first.regions[i]);
            second.regions.push_back(second.regions[i]);
        }
    const auto copied = CRepeatability().compare(first, second, cv::Matx33d::eye());
    EXPECT_EQ(copied.correspondences.size(), 50u);  // one to one, so not 250
    EXPECT_DOUBLE_EQ(copied.rate(), 50.0 / 60);
    EXPECT_NEAR(copied.nonRedundantCorrespondences, 10, 1e-4);
    EXPECT_NEAR(copied.firstNonRedundant, 20, 1e-4);
    EXPECT_NEAR(copied.nonRedundantRate(), 10.0 / 60, 1e-5);
}

TEST(CRepeatability, GivesCopiesInOnePictureNoPartner) {
    const TRegionView first{std::vector<TEllipse>(5, disc(300, 240, 20)), kPicture};
    const TRegionView second{{disc(300, 240, 20), disc(100, 100, 20)}, kPicture};
    const auto result = CRepeatability().compare(first, second, cv::Matx33d::eye());
    EXPECT_EQ(result.correspondences.size(), 1u);
    EXPECT_EQ(result.rate(), 0.5);
}

TEST(CRepeatability, IsAtTheLevelOfChanceForRandomDots) {
    // Discs of 10 px correspond up to 11.8 px apart; n of them cover this share of the centres.
    constexpr std::size_t kCount = 60;
    const double places = (640.0 - 21) * (480 - 21);
    const double chance = 1 - std::exp(-(kCount * CV_PI * 11.8 * 11.8) / places);
    std::mt19937 random(5);
    double sum = 0;
    constexpr int kRuns = 60;
    for (int run = 0; run < kRuns; ++run) {
        const auto first = randomDiscs(kCount, 10, 10, random);
        const auto second = randomDiscs(kCount, 10, 10, random);
        sum += CRepeatability().compare(first, second, cv::Matx33d::eye()).rate() / kRuns;
    }
    // 3600 regions; four standard deviations, and a little less for pairs that share a partner.
    const double sigma = std::sqrt(chance * (1 - chance) / (kRuns * kCount));
    EXPECT_LT(sum, chance + 4 * sigma);
    EXPECT_GT(sum, chance * (1 - chance) - 4 * sigma);
}

TEST(CRepeatability, LosesNothingByItsShortCuts) {
    for (const double maxError : {0.1, 0.4, 0.5, 0.7, 0.95}) {
        const auto first = whole(randomView(350, 6));
        const auto second = whole(randomView(350, 7));
        TRepeatabilityOptions options;
        options.maxOverlapError = maxError;
        const auto result = CRepeatability(options).compare(first, second, cv::Matx33d::eye());
        std::set<std::pair<std::size_t, std::size_t>> found;
        for (const auto& pair : result.correspondences) found.emplace(pair.first, pair.second);
        EXPECT_EQ(found, reference(first, second, maxError)) << maxError;
    }
}

TEST(CRepeatability, AgreesWithOpenCvsPortOfTheSurveysProgram) {
    // The second picture shows all of the first: OpenCV looks at its border only.
    const cv::Matx33d H(0.95, -0.2, 200, 0.2, 0.95, 100, 0, 0, 1);
    const cv::Mat firstPicture(kPicture, CV_8UC1, cv::Scalar(0));
    const cv::Mat secondPicture(1000, 1000, CV_8UC1, cv::Scalar(0));
    std::mt19937 random(8);
    std::normal_distribution<double> noise(0, 3);
    for (int run = 0; run < 5; ++run) {
        const auto first = randomDiscs(250, 4, 40, random);
        TRegionView second = imageOf(first, H, secondPicture.size());
        for (auto& e : second.regions)
            e = disc(e.u + noise(random), e.v + noise(random),
                     e.radius() * std::exp(noise(random) / 20));
        auto ours = keypoints(first);
        auto theirs = keypoints(second);
        float rate = 0;
        int count = 0;
        cv::evaluateFeatureDetector(firstPicture, secondPicture, cv::Mat(H), &ours, &theirs, rate,
                                    count);
        const auto result = CRepeatability().compare(first, second, H);
        EXPECT_GT(count, 50);
        // OpenCV counts points of a coarse grid and lets regions stand out by a pixel.
        EXPECT_NEAR(static_cast<double>(result.correspondences.size()), count, 0.03 * count);
        EXPECT_NEAR(result.rate(), rate, 0.03);
    }
}

TEST(CRepeatability, LeavesOutWhatLiesBeyondTheHorizon) {
    // Horizon at x = 200; the first disc would appear at (900, 540), the second is at (1900, 1740).
    const cv::Matx33d H = shift(1500, 1500) * cv::Matx33d(1, 0, 0, 0, 1, 0, 0.005, 0, -1);
    const TRegionView first{{disc(150, 240, 10), disc(400, 240, 10)}, kPicture};
    const TRegionView second{{*mapped(H, first.regions[1])}, {4000, 3000}};
    const auto result = CRepeatability().compare(first, second, H);
    EXPECT_EQ(result.firstCommon, 1u);
    EXPECT_EQ(result.rate(), 1);
}

TEST(CRepeatability, RefusesSingularMatricesAndOptionsOutOfRange) {
    const auto view = randomView(3, 9);
    EXPECT_THROW(CRepeatability().compare(view, view, cv::Matx33d::zeros()), std::invalid_argument);
    for (const double value : {0.0, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
        TRepeatabilityOptions options;
        options.maxOverlapError = value;
        EXPECT_THROW(CRepeatability{options}, std::invalid_argument) << value;
    }
}

}  // namespace
}  // namespace salma::saliency
