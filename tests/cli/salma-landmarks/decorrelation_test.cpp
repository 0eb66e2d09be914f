// SPDX-License-Identifier: BSD-3-Clause
#include <decorrelation.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace salma::apps {
namespace {

constexpr double kDegree = M_PI / 180;

/** One poster seen in `tracks` tracks of 30 views, 2 deg apart. The log ratio of two views of
 * different tracks is what each track adds at its angle, correlated as exp(-change / length). So
 * two views of a track have half of what the view of the map adds in common, at any angle. */
struct TScene {
    TScene(int tracks, double lengthDegrees) {
        std::mt19937 random(11);
        std::normal_distribution<double> normal(0, 1);
        const double keep = std::exp(-2 / lengthDegrees);
        std::vector<std::vector<double>> added(static_cast<std::size_t>(tracks));
        for (int track = 0; track < tracks; ++track) {
            double state = normal(random);
            for (int view = 0; view < 30; ++view) {
                TSeenPoster seen;
                seen.time = 100.0 * track + view;
                seen.poster = 1;
                seen.angle = (2 * view - 30) * kDegree;
                run.seen.push_back(seen);
                value.push_back(state);
                state = keep * state + std::sqrt(1 - keep * keep) * normal(random);
            }
        }
        for (std::size_t a = 0; a < run.seen.size(); ++a)
            for (std::size_t b = a + 1; b < run.seen.size(); ++b) {
                TLabelledPair pair;
                pair.a = a;
                pair.b = b;
                pairs.push_back(pair);
            }
    }
    TDecorrelation measure(TCalibrationOptions options = {}) const {
        return decorrelation(
            {run}, {pairs},
            [&](const TLabelledPair& pair) { return 3 + value[pair.a] + value[pair.b]; }, options);
    }
    TLabelledRun run;
    std::vector<TLabelledPair> pairs;
    std::vector<double> value;
};

TEST(Decorrelation, FindsTheCorrelationThatTheViewsWereDrawnWith) {
    TCalibrationOptions options;
    options.independent = 0.6;
    const auto found = TScene(60, 10).measure(options);
    EXPECT_EQ(found.tracks, 60U);
    for (const auto& bin : found.bins) {
        if (bin.from > 40 * kDegree || std::isnan(bin.correlation)) continue;
        double expected = 0;  // over the changes of 2 deg that the bin holds
        int n = 0;
        for (int change = 2; change < 60; change += 2)
            if (change * kDegree >= bin.from && change * kDegree < bin.to) {
                expected += (1 + std::exp(-change / 10.0)) / 2 * (30 - change / 2);
                n += 30 - change / 2;
            }
        EXPECT_NEAR(bin.correlation, expected / n, 0.08) << bin.from / kDegree << " deg";
    }
    ASSERT_TRUE(found.angle);  // (1 + exp(-16 / 10)) / 2 = 0.6
    EXPECT_NEAR(*found.angle, 16 * kDegree, 6 * kDegree);
}

TEST(Decorrelation, IsLongerWhereViewsStayAlikeLonger) {
    TCalibrationOptions options;
    options.independent = 0.65;
    const auto brief = TScene(60, 3).measure(options), lasting = TScene(60, 15).measure(options);
    ASSERT_TRUE(brief.angle && lasting.angle);
    EXPECT_LT(*brief.angle, *lasting.angle);
    EXPECT_LE(*brief.angle, 10 * kDegree);
}

TEST(Decorrelation, SaysNothingWithoutEnoughPairs) {
    TCalibrationOptions options;
    options.minPairs = 1000000;
    EXPECT_FALSE(TScene(3, 10).measure(options).angle);
    EXPECT_FALSE(TScene(1, 10).measure().angle) << "nothing to compare a single track with";
}

TEST(Decorrelation, BeginsANewTrackAfterAGap) {
    TCalibrationOptions options;
    options.trackGap = 0.5;  // shorter than between any two views
    EXPECT_EQ(TScene(2, 10).measure(options).tracks, 60U);
}

}  // namespace
}  // namespace salma::apps
