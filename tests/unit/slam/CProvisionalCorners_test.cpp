// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/CProvisionalCorners.h>

namespace salma::slam {
namespace {

TEST(CProvisionalCorners, ConfirmsAtTheThirdSightingAndForgetsThen) {
    CProvisionalCorners corners(3, 0.3, 5);
    for (int i = 0; i < 2; ++i) {
        corners.beginStep();
        EXPECT_FALSE(corners.confirms({1 + 0.1 * i, 0}, true));
    }
    corners.beginStep();
    EXPECT_TRUE(corners.confirms({1.2, 0}, true));
    EXPECT_EQ(corners.size(), 0u);
}

TEST(CProvisionalCorners, CountsOneSightingPerStep) {
    CProvisionalCorners corners(2, 0.3, 5);
    corners.beginStep();
    EXPECT_FALSE(corners.confirms({1, 0}, true));
    EXPECT_FALSE(corners.confirms({1.1, 0}, true));
    EXPECT_EQ(corners.size(), 2u);
}

TEST(CProvisionalCorners, KeepsPlacesAndConvexityApart) {
    CProvisionalCorners corners(2, 0.3, 5);
    corners.beginStep();
    EXPECT_FALSE(corners.confirms({1, 0}, true));
    corners.beginStep();
    EXPECT_FALSE(corners.confirms({1.31, 0}, true));
    EXPECT_FALSE(corners.confirms({1, 0}, false));
    EXPECT_TRUE(corners.confirms({1.01, 0}, true));
}

TEST(CProvisionalCorners, ForgetsWhatIsNotSeenAgain) {
    CProvisionalCorners corners(2, 0.3, 2);
    corners.beginStep();
    EXPECT_FALSE(corners.confirms({1, 0}, true));
    for (int i = 0; i < 3; ++i) corners.beginStep();
    EXPECT_EQ(corners.size(), 0u);
    EXPECT_FALSE(corners.confirms({1, 0}, true));
}

TEST(CProvisionalCorners, TakesEveryCornerWhereOneSightingIsEnough) {
    CProvisionalCorners corners(1, 0.3, 2);
    corners.beginStep();
    EXPECT_TRUE(corners.confirms({1, 0}, true));
}

}  // namespace
}  // namespace salma::slam
