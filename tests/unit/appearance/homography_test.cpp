// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/appearance/homography.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>

namespace salma::appearance {
namespace {

using mrpt::math::TPoint2D;
using Points = std::vector<TPoint2D>;

TPoint2D mapped(const Eigen::Matrix3d& H, const TPoint2D& p) {
    const Eigen::Vector3d q = H * Eigen::Vector3d(p.x, p.y, 1);
    return {q.x() / q.z(), q.y() / q.z()};
}

const Points kQuad{{102, 80}, {410, 130}, {395, 370}, {90, 420}};
const Points kMetres{{0, 0.6}, {0.8, 0.6}, {0.8, 0}, {0, 0}};

TEST(Homography, MapsFourPointsExactlyAndBack) {
    const auto H = homographyFrom(kQuad, kMetres), back = homographyFrom(kMetres, kQuad);
    ASSERT_TRUE(H && back);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(mapped(*H, kQuad[i]).x, kMetres[i].x, 1e-12);
        EXPECT_NEAR(mapped(*H, kQuad[i]).y, kMetres[i].y, 1e-12);
    }
    const Eigen::Matrix3d one = *back * *H;
    EXPECT_LT((one / one(2, 2) - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    EXPECT_NEAR(H->norm(), 1, 1e-12);
}

TEST(Homography, AgreesWithOpenCvOnManyPoints) {
    Eigen::Matrix3d truth;
    truth << 0.9, 0.1, 20, -0.15, 0.95, 40, 2e-4, 1e-4, 1;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0, 600);
    Points from, to;
    std::vector<cv::Point2d> a, b;
    for (int i = 0; i < 20; ++i) {
        from.push_back({place(random), place(random)});
        to.push_back(mapped(truth, from.back()));
        a.emplace_back(from.back().x, from.back().y);
        b.emplace_back(to.back().x, to.back().y);
    }
    const auto H = homographyFrom(from, to);
    ASSERT_TRUE(H);
    const cv::Matx33d other = cv::findHomography(a, b, 0);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR((*H)(r, c) / (*H)(2, 2), other(r, c), 1e-6 * (1 + std::abs(other(r, c))));
}

TEST(Homography, IsNoWorseFarFromTheOrigin) {
    Points far = kQuad;
    for (auto& p : far) p = {p.x + 1e6, p.y - 2e6};
    const auto H = homographyFrom(far, kMetres);
    ASSERT_TRUE(H);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(mapped(*H, far[i]).x, kMetres[i].x, 1e-6);
}

TEST(Homography, RefusesQuadsThatDetermineNone) {
    const double nan = std::nan("");
    const Points inLine{{0, 0}, {100, 0}, {200, 0}, {50, 80}};
    const Points allInLine{{0, 0}, {1, 1}, {2, 2}, {3, 3}};
    const Points onePlace{{5, 5}, {5, 5}, {5, 5}, {5, 5}};
    const Points twice{{0, 0}, {0, 0}, {100, 100}, {0, 100}};
    const Points crossed{{0, 0}, {100, 100}, {100, 0}, {0, 100}};
    const Points dented{{0, 0}, {100, 0}, {30, 20}, {0, 100}};
    const Points holed{{0, 0}, {nan, 0}, {100, 100}, {0, 100}};
    for (const Points& bad : {inLine, allInLine, onePlace, twice, crossed, dented, holed}) {
        EXPECT_FALSE(homographyFrom(bad, kMetres));
        EXPECT_FALSE(homographyFrom(kMetres, bad));
    }
    EXPECT_FALSE(homographyFrom({{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_FALSE(homographyFrom(kQuad, {{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_FALSE(homographyFrom({}, {}));
}

TEST(RectifyQuad, ShowsAChessboardUpright) {
    cv::Mat board(400, 600, CV_8UC1), picture;
    for (int r = 0; r < board.rows; ++r)
        for (int c = 0; c < board.cols; ++c)
            board.at<std::uint8_t>(r, c) = (r / 100 + c / 100) % 2 == 0 ? 220 : 30;
    const auto H =
        homographyFrom({{-0.5, -0.5}, {599.5, -0.5}, {599.5, 399.5}, {-0.5, 399.5}}, kQuad);
    ASSERT_TRUE(H);
    cv::Matx33d map;
    for (int i = 0; i < 9; ++i) map.val[i] = (*H)(i / 3, i % 3);
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
    Eigen::Matrix3d truth;
    std::ifstream file(folder + "/H_1_2");
    for (int i = 0; i < 9; ++i) file >> truth(i / 3, i % 3);
    ASSERT_TRUE(file);
    const cv::Mat second = cv::imread(folder + "/2.png", cv::IMREAD_GRAYSCALE);
    const Points here{{250, 450}, {650, 450}, {650, 750}, {250, 750}};
    Points there;
    for (const auto& p : here) there.push_back(mapped(truth, p));
    const cv::Mat a = rectifyQuad(first, here, {200, 150});
    const cv::Mat b = rectifyQuad(second, there, {200, 150});
    ASSERT_FALSE(b.empty());
    cv::Mat correlation;
    cv::matchTemplate(a, b, correlation, cv::TM_CCOEFF_NORMED);
    EXPECT_GT(correlation.at<float>(0, 0), 0.9F);
}

}  // namespace
}  // namespace salma::appearance
