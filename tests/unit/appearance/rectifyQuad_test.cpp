// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/appearance/rectifyQuad.h>
#include <salma/calibration/CHomography.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace salma::appearance {
namespace {

using calibration::CHomography;
using Points = std::vector<mrpt::math::TPoint2D>;

const Points kQuad{{102, 80}, {410, 130}, {395, 370}, {90, 420}};

TEST(RectifyQuad, ShowsAChessboardUpright) {
    cv::Mat board(400, 600, CV_8UC1), picture;
    for (int r = 0; r < board.rows; ++r)
        for (int c = 0; c < board.cols; ++c)
            board.at<std::uint8_t>(r, c) = (r / 100 + c / 100) % 2 == 0 ? 220 : 30;
    const auto H =
        CHomography::through({{-0.5, -0.5}, {599.5, -0.5}, {599.5, 399.5}, {-0.5, 399.5}}, kQuad);
    ASSERT_TRUE(H);
    cv::Matx33d map;
    for (int i = 0; i < 9; ++i) map.val[i] = H->matrix()(i / 3, i % 3);
    cv::warpPerspective(board, picture, map, {500, 500});
    const cv::Mat patch = rectifyQuad(picture, kQuad, {150, 100});
    ASSERT_EQ(patch.size(), cv::Size(150, 100));
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 6; ++c)
            EXPECT_NEAR(patch.at<std::uint8_t>(25 * r + 12, 25 * c + 12),
                        (r + c) % 2 == 0 ? 220 : 30, 20);
    EXPECT_TRUE(rectifyQuad(picture, {kQuad[1], kQuad[0], kQuad[3], kQuad[2]}, {150, 100}).empty())
        << "mirrored";
    EXPECT_TRUE(rectifyQuad(picture, {{0, 0}, {9, 0}, {20, 0}, {0, 9}}, {9, 9}).empty());
    EXPECT_THROW(rectifyQuad(cv::Mat(9, 9, CV_8UC3), kQuad, {9, 9}), std::invalid_argument);
    EXPECT_THROW(rectifyQuad(picture, kQuad, {0, 9}), std::invalid_argument);
}

TEST(RectifyQuad, BringsTwoViewsOfAMuralToOnePicture) {
    SALMA_NEED_DATA(folder, "homography/churchill");
    const cv::Mat first = cv::imread(folder + "/1.png", cv::IMREAD_GRAYSCALE);
    cv::Matx33d truth;
    std::ifstream file(folder + "/H_1_2");
    for (double& entry : truth.val) file >> entry;
    ASSERT_TRUE(file);
    const cv::Mat second = cv::imread(folder + "/2.png", cv::IMREAD_GRAYSCALE);
    const Points here{{250, 450}, {650, 450}, {650, 750}, {250, 750}};
    Points there;
    for (const auto& p : here) {
        const cv::Vec3d q = truth * cv::Vec3d(p.x, p.y, 1);
        there.push_back({q[0] / q[2], q[1] / q[2]});
    }
    const cv::Mat a = rectifyQuad(first, here, {200, 150});
    const cv::Mat b = rectifyQuad(second, there, {200, 150});
    ASSERT_FALSE(b.empty());
    cv::Mat correlation;
    cv::matchTemplate(a, b, correlation, cv::TM_CCOEFF_NORMED);
    EXPECT_GT(correlation.at<float>(0, 0), 0.9F);
}

}  // namespace
}  // namespace salma::appearance
