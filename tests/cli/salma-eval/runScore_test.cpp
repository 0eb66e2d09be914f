// SPDX-License-Identifier: BSD-3-Clause
#include "runScore.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace salma::apps {
namespace {

using association::ELandmarkKind;
using mrpt::poses::CPose2D;
using slam::EDecision;

constexpr int kSteps = 200;  // of two laps round a circle of 5 m

double timeOf(int step) { return 100 + 0.2 * step; }
CPose2D onCircle(int step) {
    const double angle = 4 * M_PI * step / kSteps;
    return {5 * std::sin(angle), 5 - 5 * std::cos(angle), angle};
}

/// Two laps and two posters.
TTruth truthOfTwoLaps() {
    TTruth truth;
    truth.name = "circle";
    viz::TTrajectory path;
    for (int i = 0; i <= kSteps; ++i) path.push_back({timeOf(i), onCircle(i)});
    truth.path = path;
    TTrueLandmark a, b;
    a.id = 1;
    b.id = 2;
    a.texture = "exit";
    b.texture = "notice";
    truth.landmarks = {a, b};
    return truth;
}

/// What a run makes of it that adds `error` to the truth.
slam::TRunRecord runWith(const std::function<CPose2D(int)>& error) {
    slam::TRunRecord record;
    for (int i = 0; i <= kSteps; ++i) {
        slam::TTrajectoryRow row;
        row.time = timeOf(i);
        const CPose2D e = error(i), there = onCircle(i);
        row.pose = row.running = row.odometry =
            CPose2D(there.x() + e.x(), there.y() + e.y(), there.phi());
        record.trajectory.push_back(row);
    }
    return record;
}

TEST(RunScore, MeasuresTheLastLapByItselfAndInThePath) {
    // from the second lap on all is 2 m to the side: the lap is right in itself
    const auto record = runWith([](int i) { return CPose2D(i >= kSteps / 2 ? 2.0 : 0.0, 0, 0); });
    const auto score = scoreRun(record, truthOfTwoLaps(), 2);
    EXPECT_NEAR(score.ateLastLap, 0, 0.05);
    EXPECT_NEAR(score.lastLapInPath, 1, 0.05) << "half of it goes into the alignment";
    EXPECT_NEAR(score.ate, 1, 0.05);
    EXPECT_NEAR(score.finalError, 2, 1e-9);
    EXPECT_NEAR(score.maxJump, 2, 1e-9);
    EXPECT_TRUE(std::isnan(score.nees)) << "no step has a covariance";
    const auto oneLap = scoreRun(record, truthOfTwoLaps(), 1);
    EXPECT_NEAR(oneLap.ateLastLap, oneLap.ate, 1e-12);
}

TEST(RunScore, CountsWrongPairsThatComeAgain) {
    auto truth = truthOfTwoLaps();
    auto record = runWith([](int) { return CPose2D(); });
    const auto see = [&](int step, int poster, EDecision decision, int landmark) {
        TTrueSighting sighting;
        sighting.time = timeOf(step);
        sighting.landmark = poster;
        sighting.range = 2;
        truth.sightings.push_back(sighting);
        slam::TAssociationRow row;
        row.time = timeOf(step);
        row.kind = ELandmarkKind::salient;
        row.range = 2;
        row.u = row.v = std::nan("");
        row.decision = decision;
        row.landmark = landmark;
        record.associations.push_back(row);
    };
    see(10, 1, EDecision::created, 0);
    see(11, 1, EDecision::paired, 0);
    see(20, 2, EDecision::paired, 0);  // once: not yet a loop
    EXPECT_EQ(scoreRun(record, truth, 2).repeatedWrongPairs, 0u);
    see(21, 2, EDecision::paired, 0);
    see(30, 1, EDecision::relocated, 0);
    const auto score = scoreRun(record, truth, 2);
    EXPECT_EQ(score.repeatedWrongPairs, 1u);
    EXPECT_EQ(score.wrongCopies, 0u) << "they look different";
    truth.landmarks[1].texture = "exit";
    EXPECT_EQ(scoreRun(record, truth, 2).wrongCopies, 2u);
    truth.landmarks[0].texture = truth.landmarks[1].texture = "";
    EXPECT_EQ(scoreRun(record, truth, 2).wrongCopies, 0u) << "what is not known is no copy";
    EXPECT_EQ(score.salient.wrong, 2u);
    EXPECT_EQ(score.salient.right, 2u);
    EXPECT_EQ(score.salient.judged, 4u);
    EXPECT_EQ(score.relocations, 1u);
    EXPECT_EQ(score.corners.judged, 0u);
}

TEST(RunScore, NeedsTheTruePath) {
    auto truth = truthOfTwoLaps();
    truth.path.reset();
    EXPECT_THROW(scoreRun(runWith([](int) { return CPose2D(); }), truth, 2), std::invalid_argument);
}

}  // namespace
}  // namespace salma::apps
