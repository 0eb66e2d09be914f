// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/viz/doubtfulPairings.h>

#include <cmath>

namespace salma::viz {
namespace {

using association::ELandmarkKind;
using slam::EDecision;

constexpr double kGate = 9.21;

slam::TRunRecord recordOf(const std::vector<slam::TAssociationRow>& rows) {
    slam::TRunRecord record;
    record.associations = rows;
    return record;
}

slam::TAssociationRow pairing(double time, int landmark, double distance2, double logRatio) {
    slam::TAssociationRow row;
    row.time = time;
    row.kind = ELandmarkKind::salient;
    row.decision = EDecision::paired;
    row.landmark = landmark;
    row.distance2 = distance2;
    row.logRatio = logRatio;
    return row;
}

TEST(DoubtfulPairings, WithoutARivalTheEdgeOfTheGateIsTheMeasure) {
    const auto found = doubtfulPairings(recordOf({pairing(1, 3, 2, 5)}), 5, kGate);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].margin, 5 - 1 + kGate / 2, 1e-12);
    EXPECT_EQ(found[0].rival, -1);
    EXPECT_TRUE(std::isnan(found[0].rivalDistance2));
}

TEST(DoubtfulPairings, TheBestOtherCandidateOfTheSameObservationIsTheRival) {
    auto record = recordOf({pairing(1, 3, 2, 5)});
    record.candidates = {{1, 0, 3, 2, 5, true},          {1, 0, 4, 1, 4, false},
                         {1, 0, 5, 1, 3.5, false},       {1, 1, 6, 0.1, 9, false},
                         {2, 0, 7, 0.1, 9, false},       {1, 0, 8, 9, -8, false},
                         {1, 0, 9, 12, 20, false, false}};  // outside the gate: no rival
    const auto found = doubtfulPairings(record, 5, kGate);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].rival, 4);
    EXPECT_EQ(found[0].rivalDistance2, 1);
    EXPECT_EQ(found[0].rivalLogRatio, 4);
    EXPECT_NEAR(found[0].margin, (5 - 1) - (4 - 0.5), 1e-12);
}

TEST(DoubtfulPairings, AppearanceThatDidNotCountSpeaksNeitherForNorAgainst) {
    const auto found = doubtfulPairings(recordOf({pairing(1, 3, 2, std::nan(""))}), 5, kGate);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].margin, -1 + kGate / 2, 1e-12);
}

TEST(DoubtfulPairings, WorstFirstAndNoMoreThanAskedFor) {
    const auto record = recordOf(
        {pairing(1, 1, 1, 1), pairing(2, 2, 9, -3), pairing(3, 3, 4, 0), pairing(4, 4, 4, 0)});
    const auto found = doubtfulPairings(record, 3, kGate);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].row, 1U);
    EXPECT_EQ(found[1].row, 2U);
    EXPECT_EQ(found[2].row, 3U);
}

TEST(DoubtfulPairings, OnlyPairingsOfSalientLandmarksThatWereJudged) {
    auto corner = pairing(1, 1, 9, 0);
    corner.kind = ELandmarkKind::corner;
    auto fresh = pairing(2, 2, 9, 0);
    fresh.decision = EDecision::created;
    const auto byIdentity = pairing(3, 3, std::nan(""), std::nan(""));
    EXPECT_TRUE(doubtfulPairings(recordOf({corner, fresh, byIdentity})).empty());
    auto relocated = pairing(4, 4, 9, 0);
    relocated.decision = EDecision::relocated;
    EXPECT_EQ(doubtfulPairings(recordOf({relocated})).size(), 1U);
}

}  // namespace
}  // namespace salma::viz
