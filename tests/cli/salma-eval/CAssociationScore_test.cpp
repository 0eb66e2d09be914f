// SPDX-License-Identifier: BSD-3-Clause
#include <CAssociationScore.h>
#include <gtest/gtest.h>

namespace salma::apps {
namespace {

using slam::EDecision;

slam::TAssociationRow row(double time, EDecision decision, int landmark = -1) {
    slam::TAssociationRow r;
    r.time = time;
    r.decision = decision;
    r.landmark = landmark;
    return r;
}

TEST(CAssociationScore, CountsRightAndWrongPairings) {
    CAssociationScore score;
    score.add(row(1, EDecision::created, 0), 10);
    score.add(row(1, EDecision::created, 1), 11);
    score.add(row(2, EDecision::paired, 0), 10);
    score.add(row(3, EDecision::paired, 1), 10);  // wrong
    score.add(row(4, EDecision::relocated, 1), 11);
    const auto f = score.figures(3);
    EXPECT_EQ(f.precision.count, 2U);
    EXPECT_EQ(f.precision.total, 3U);
    EXPECT_EQ(f.recall.count, 2U);
    EXPECT_EQ(f.recall.total, 3U);
    ASSERT_EQ(f.wrong.size(), 1U);
    EXPECT_EQ(f.wrong[0].time, 3);
    EXPECT_EQ(f.wrong[0].landmark, 1);
    EXPECT_EQ(f.wrong[0].landmarkTruth, 11);
    EXPECT_EQ(f.wrong[0].observationTruth, 10);
    EXPECT_EQ(f.landmarksMade, 2U);
    EXPECT_EQ(f.landmarksCovered, 2U);
    EXPECT_EQ(f.trueLandmarks, 3U);
    EXPECT_EQ(f.duplicateLandmarks(), 0U);
}

TEST(CAssociationScore, FindsTheLandmarkThatWasMadeTwice) {
    CAssociationScore score;
    score.add(row(1, EDecision::created, 0), 10);
    score.add(row(2, EDecision::created, 5), 10);
    score.add(row(3, EDecision::created, 7), 10);
    score.add(row(4, EDecision::paired, 5), 10);  // to the right poster
    const auto f = score.figures(1);
    ASSERT_EQ(f.duplicates.size(), 1U);
    EXPECT_EQ(f.duplicates[0].truth, 10);
    EXPECT_EQ(f.duplicates[0].landmarks, (std::vector<int>{0, 5, 7}));
    EXPECT_EQ(f.duplicateLandmarks(), 2U);
    EXPECT_EQ(f.recall.count, 1U);
    EXPECT_EQ(f.recall.total, 3U) << "the second and third landmark were missed sightings";
    EXPECT_EQ(f.precision.total, 1U);
}

TEST(CAssociationScore, CountsDeferredAndDroppedSightingsOfMappedLandmarksAsMissed) {
    CAssociationScore score;
    score.add(row(1, EDecision::deferred), 10);  // not mapped yet
    score.add(row(2, EDecision::created, 0), 10);
    score.add(row(3, EDecision::deferred), 10);
    score.add(row(4, EDecision::clutter), 10);
    score.add(row(5, EDecision::paired, 0), 10);
    const auto f = score.figures(1);
    EXPECT_EQ(f.recall.count, 1U);
    EXPECT_EQ(f.recall.total, 3U);
    EXPECT_EQ(f.deferred, 1U);
    EXPECT_EQ(f.observations, 5U);
}

TEST(CAssociationScore, DoesNotAskForAPairingWithinTheStepThatMadeTheLandmark) {
    CAssociationScore score;
    score.add(row(1, EDecision::created, 0), 10);
    score.add(row(1, EDecision::deferred), 10);
    EXPECT_EQ(score.figures(1).recall.total, 0U);
}

TEST(CAssociationScore, KeepsFalseEntitiesApart) {
    CAssociationScore score;
    score.add(row(1, EDecision::created, 0), -1);
    score.add(row(2, EDecision::paired, 0), -1);  // a door plate again: cannot be judged
    score.add(row(2, EDecision::created, 1), 10);
    score.add(row(3, EDecision::paired, 0), 10);  // a poster taken for the door plate
    score.add(row(4, EDecision::paired, 1), -1);  // and the other way round
    const auto f = score.figures(1);
    EXPECT_EQ(f.falseEntities, 3U);
    EXPECT_EQ(f.falseLandmarks, 1U);
    EXPECT_EQ(f.unjudged, 1U);
    EXPECT_EQ(f.wrongWithFalse, 2U);
    EXPECT_TRUE(f.wrong.empty()) << "not between two posters";
    EXPECT_EQ(f.precision.count, 0U);
    EXPECT_EQ(f.precision.total, 2U);
    EXPECT_EQ(f.recall.total, 1U);
}

TEST(CAssociationScore, LearnsWhatALandmarkOfAnOlderMapIsFromItsFirstPairing) {
    CAssociationScore score;
    score.add(row(1, EDecision::paired, 4), 10);
    score.add(row(2, EDecision::paired, 4), 11);
    const auto f = score.figures(2);
    EXPECT_EQ(f.unjudged, 1U);
    EXPECT_EQ(f.landmarksMade, 0U);
    EXPECT_EQ(f.wrong.size(), 1U);
}

}  // namespace
}  // namespace salma::apps
