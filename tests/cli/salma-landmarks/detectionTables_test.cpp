// SPDX-License-Identifier: BSD-3-Clause
#include <detectionTables.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace salma::apps {
namespace {

using association::ELandmarkKind;

constexpr double kDegrees = 180 / M_PI;

slam::TDetectionOptions knots() {
    slam::TDetectionOptions options;
    options.incidence = {0, 60, 90};
    options.byIncidence = {0.9, 0.8, 0.1};
    options.range = {0, 4, 8};
    options.byRange = {0.5, 1, 0.25};
    options.cornerRange = {0, 5};
    options.byCornerRange = {0.7, 0.3};
    return options;
}

TTrueView view(ELandmarkKind kind, int thing, double incidence, double range) {
    TTrueView result;
    result.kind = kind;
    result.thing = std::to_string(thing);
    result.incidence = incidence / kDegrees;
    result.range = range;
    return result;
}

/// Views from everywhere that are found as `tables` say, each of another thing.
TLabelledRun drawn(const slam::TDetectionOptions& tables, int views) {
    std::mt19937 random(5);
    const auto uniform = [&] { return random() / 4294967296.0; };
    TLabelledRun run;
    for (int i = 0; i < views; ++i) {
        auto poster = view(ELandmarkKind::salient, i, 90 * uniform(), 9 * uniform());
        poster.inView = i % 3 == 0 ? 0.5 : 1;
        poster.seen =
            uniform() < poster.inView * tables.probability(poster.incidence, poster.range);
        auto corner = view(ELandmarkKind::corner, i, 0, 6 * uniform());
        corner.seen = uniform() < tables.cornerProbability(corner.range);
        run.views.push_back(poster);
        run.views.push_back(corner);
    }
    return run;
}

TEST(DetectionTables, AreFoundAgainFromWhatTheyMake) {
    TCalibrationOptions options;
    options.spoiltRate = 1e-6;
    auto start = knots();
    start.byIncidence = start.byRange = {0.5, 0.5, 0.5};
    start.byCornerRange = {0.5, 0.5};
    const auto learned = learnDetection({drawn(knots(), 20000)}, start, options);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(learned.byIncidence[k], knots().byIncidence[k], 0.04) << k;
        EXPECT_NEAR(learned.byRange[k], knots().byRange[k], 0.04) << k;
    }
    EXPECT_NEAR(learned.byCornerRange[0], 0.7, 0.03);
    EXPECT_NEAR(learned.byCornerRange[1], 0.3, 0.03);
    EXPECT_EQ(learned.incidence, knots().incidence);
}

TEST(DetectionTables, TakeAShareOfSpoiltViewsOffPosters) {
    TCalibrationOptions options;
    options.spoiltRate = 1e-6;
    const auto clear = learnDetection({drawn(knots(), 2000)}, knots(), options);
    options.spoiltRate = 0.2;
    const auto spoilt = learnDetection({drawn(knots(), 2000)}, knots(), options);
    EXPECT_NEAR(spoilt.byIncidence[0], 0.8 * clear.byIncidence[0], 0.01);
    EXPECT_EQ(spoilt.byRange, clear.byRange);
    EXPECT_EQ(spoilt.byCornerRange, clear.byCornerRange);
}

TEST(DetectionTables, CountAThingThatIsSeenForLongAFewTimesOnly) {
    TLabelledRun often;  // one corner is found whenever it is looked at, another one never
    for (int i = 0; i < 606; ++i) {
        often.views.push_back(view(ELandmarkKind::corner, i < 600 ? 1 : 2, 0, 0));
        often.views.back().seen = i < 600;
    }
    auto configured = knots();
    configured.cornerRange = {0};
    configured.byCornerRange = {0.5};
    TCalibrationOptions options;
    options.perPoster = 3;
    options.priorCount = 1;
    // 3 looks at each, though one was looked at 600 times and the other 6 times.
    EXPECT_NEAR(learnDetection({often}, configured, options).byCornerRange[0], 0.5, 0.005);
    // One poster that was always found straight ahead, one that was not seen along its wall.
    auto slanting = knots();
    slanting.incidence = {0, 90};
    slanting.byIncidence = {0.5, 0.5};
    slanting.range = {0};
    slanting.byRange = {1};
    TLabelledRun posters;
    for (int i = 0; i < 1000; ++i) {
        posters.views.push_back(view(ELandmarkKind::salient, 1, 0, 1));
        posters.views.back().seen = true;
    }
    options.spoiltRate = 1e-6;
    const auto learned = learnDetection({posters}, slanting, options);
    EXPECT_NEAR(learned.byIncidence[0], 1, 0.005);
    EXPECT_NEAR(learned.byIncidence[1], 0, 0.005) << "the prior: nothing is seen from aside";
}

TEST(DetectionTables, StayAsConfiguredWithoutViews) {
    const auto learned = learnDetection({TLabelledRun()}, knots(), {});
    EXPECT_EQ(learned.byIncidence, knots().byIncidence);
    EXPECT_EQ(learned.byCornerRange, knots().byCornerRange);
    const auto loss = detectionLoss({TLabelledRun()}, ELandmarkKind::salient, learned, knots());
    EXPECT_EQ(loss.views, 0U);
    EXPECT_EQ(loss.learned, 0);
}

TEST(DetectionTables, AreJudgedByWhatTheySayOfEachView) {
    TLabelledRun run;
    run.views = {view(ELandmarkKind::salient, 1, 0, 4), view(ELandmarkKind::salient, 1, 60, 4),
                 view(ELandmarkKind::corner, 2, 0, 5)};
    run.views[0].seen = true;
    run.views[1].inView = 0.5;
    auto learned = knots();
    learned.byIncidence = {0.5, 0.5, 0.5};
    const auto posters = detectionLoss({run}, ELandmarkKind::salient, learned, knots());
    EXPECT_EQ(posters.views, 2U);
    EXPECT_EQ(posters.found, 1U);
    EXPECT_NEAR(posters.learned, -(std::log(0.5) + std::log(0.75)) / 2, 1e-9);
    EXPECT_NEAR(posters.configured, -(std::log(0.9) + std::log(0.6)) / 2, 1e-9);
    const auto corners = detectionLoss({run}, ELandmarkKind::corner, learned, knots());
    EXPECT_NEAR(corners.learned, -std::log(0.7), 1e-9);
}

}  // namespace
}  // namespace salma::apps
