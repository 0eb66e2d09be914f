// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/observations/CPoseHistory.h>

#include <cmath>

using mrpt::poses::CPose2D;
using salma::observations::CPoseHistory;

TEST(CPoseHistory, InterpolatesPositionLinearly) {
    CPoseHistory history;
    history.add(10, CPose2D(1, 2, 0.2));
    history.add(12, CPose2D(3, -2, 0.6));
    const auto pose = history.at(10.5, 0);
    ASSERT_TRUE(pose);
    EXPECT_DOUBLE_EQ(pose->x(), 1.5);
    EXPECT_DOUBLE_EQ(pose->y(), 1);
    EXPECT_NEAR(pose->phi(), 0.3, 1e-15);
}

TEST(CPoseHistory, HeadingsGoTheShortWayAcrossPi) {
    CPoseHistory history;
    history.add(0, CPose2D(0, 0, M_PI - 0.1));
    history.add(1, CPose2D(0, 0, -M_PI + 0.3));
    EXPECT_NEAR(history.at(0.125, 0)->phi(), M_PI - 0.05, 1e-12);
    EXPECT_NEAR(history.at(0.5, 0)->phi(), -M_PI + 0.1, 1e-12);
}

TEST(CPoseHistory, GivesTheStoredPoseAtEachStamp) {
    CPoseHistory history;
    for (int i = 0; i < 7; ++i) history.add(i * 0.1, CPose2D(i, -i, 0));
    for (int i = 0; i < 7; ++i) EXPECT_DOUBLE_EQ(history.at(i * 0.1, 0)->x(), i);
}

TEST(CPoseHistory, HoldsTheEndsWithinTheSkewAndNoFurther) {
    CPoseHistory history;
    history.add(1, CPose2D(5, 0, 0));
    history.add(2, CPose2D(6, 0, 0));
    EXPECT_DOUBLE_EQ(history.at(0.75, 0.25)->x(), 5);
    EXPECT_DOUBLE_EQ(history.at(2.25, 0.25)->x(), 6);
    EXPECT_FALSE(history.at(0.5, 0.25));
    EXPECT_FALSE(history.at(2.5, 0.25));
    EXPECT_FALSE(history.at(std::nan(""), 10));
    EXPECT_FALSE(history.at(1.5, std::nan("")));
}

TEST(CPoseHistory, OfEqualStampsTheLastCounts) {
    CPoseHistory history;
    history.add(1, CPose2D(5, 0, 0));
    history.add(1, CPose2D(7, 0, 0));
    EXPECT_DOUBLE_EQ(history.at(1, 0)->x(), 7);
}

TEST(CPoseHistory, RefusesDecreasingStampsAndNan) {
    CPoseHistory history;
    EXPECT_TRUE(history.empty());
    EXPECT_FALSE(history.at(0, 1e9));
    EXPECT_THROW(history.add(std::nan(""), CPose2D()), std::invalid_argument);
    history.add(1, CPose2D());
    EXPECT_THROW(history.add(0.5, CPose2D()), std::invalid_argument);
    EXPECT_FALSE(history.empty());
}

TEST(CPoseHistory, ForgetsWhatIsOldButKnowsTheTimeItWasAskedToKeep) {
    CPoseHistory history;
    for (int i = 0; i < 10; ++i) history.add(i, CPose2D(i, 0, 0));
    history.forgetBefore(4.5);
    EXPECT_FALSE(history.at(3.9, 0));
    EXPECT_DOUBLE_EQ(history.at(4, 0)->x(), 4);
    EXPECT_DOUBLE_EQ(history.at(4.5, 0)->x(), 4.5);
    history.forgetBefore(5);
    EXPECT_FALSE(history.at(4.9, 0));
    EXPECT_DOUBLE_EQ(history.at(5, 0)->x(), 5);
    history.forgetBefore(-1);
    EXPECT_DOUBLE_EQ(history.at(9, 0)->x(), 9);
    history.forgetBefore(100);
    EXPECT_DOUBLE_EQ(history.at(9, 0)->x(), 9) << "the last pose stays";
    CPoseHistory().forgetBefore(1);
}
