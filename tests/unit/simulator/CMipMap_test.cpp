// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/simulator/CMipMap.h>

#include <stdexcept>

namespace salma::simulator {
namespace {

cv::Mat_<cv::Vec3b> checkers(int size) {
    cv::Mat_<cv::Vec3b> picture(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            picture(y, x) = (x + y) % 2 == 0 ? cv::Vec3b(200, 200, 200) : cv::Vec3b(0, 0, 0);
    return picture;
}

TEST(CMipMap, ReturnsATexelAtItsCentre) {
    cv::Mat_<cv::Vec3b> picture(4, 8, cv::Vec3b(0, 0, 0));
    picture(1, 5) = {10, 20, 30};  // row 1, column 5
    const CMipMap map(picture, false);
    const cv::Vec3f colour = map.sample({5.5f / 8, 1.5f / 4}, {0.01f, 0}, {0, 0.01f});
    EXPECT_NEAR(colour[0], 10, 1e-3);
    EXPECT_NEAR(colour[2], 30, 1e-3);
}

TEST(CMipMap, AveragesCheckersToGreyFromAfar) {
    const CMipMap map(checkers(64), true);
    EXPECT_NEAR(map.sample({0.3f, 0.7f}, {0.25f, 0}, {0, 0.25f})[0], 100, 1);
    EXPECT_NEAR(map.sample({0.3f, 0.7f}, {0.25f, 0}, {0, 0.03f})[0], 100, 2);  // slanted
}

TEST(CMipMap, RepeatsOrHoldsItsBorder) {
    cv::Mat_<cv::Vec3b> picture(1, 4, cv::Vec3b(0, 0, 0));
    picture(0, 0) = {100, 100, 100};
    const cv::Vec2f beyond(1.125f, 0.5f), tiny(0.001f, 0), down(0, 0.001f);
    EXPECT_NEAR(CMipMap(picture, true).sample(beyond, tiny, down)[0], 100, 1e-3);
    EXPECT_NEAR(CMipMap(picture, false).sample(beyond, tiny, down)[0], 0, 1e-3);
}

TEST(CMipMap, RefusesAnEmptyPicture) {
    EXPECT_THROW(CMipMap(cv::Mat(), true), std::invalid_argument);
}

}  // namespace
}  // namespace salma::simulator
