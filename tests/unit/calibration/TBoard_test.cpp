// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/calibration/TBoard.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "CSimulatedRig.h"

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;

double distance(const TPoint2D& a, const TPoint2D& b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(FindBoard, FindsCornersOfAChessboardToAFractionOfAPixel) {
    CSimulatedRig rig(21);
    rig.sigmaPixels = 0;
    const auto pairs = rig.pairs(3);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const cv::Mat picture = rig.picture(rig.boards()[i]);
        auto found = findBoard(picture, rig.board());
        ASSERT_TRUE(found) << i;
        ASSERT_EQ(found->size(), 54u);
        if (distance(found->front(), pairs[i].pixels.front()) > 10)  // turned by 180 degrees
            std::reverse(found->begin(), found->end());
        double squares = 0;
        for (std::size_t k = 0; k < 54; ++k)
            squares += std::pow(distance((*found)[k], pairs[i].pixels[k]), 2) / 54;
        EXPECT_LT(std::sqrt(squares), 0.25) << i;
    }
}

TEST(FindBoard, TellsDarkSquaresFromBrightOnes) {
    CSimulatedRig rig(23);
    auto pixels = rig.pairs(1)[0].pixels;
    const cv::Mat picture = rig.picture(rig.boards()[0]);
    EXPECT_TRUE(firstSquareIsDark(picture, rig.board(), pixels));
    EXPECT_FALSE(firstSquareIsDark(255 - picture, rig.board(), pixels));
    std::reverse(pixels.begin(), pixels.end());  // 8 x 5 squares: the other way it begins bright
    EXPECT_FALSE(firstSquareIsDark(picture, rig.board(), pixels));
    pixels.pop_back();
    EXPECT_THROW(firstSquareIsDark(picture, rig.board(), pixels), std::invalid_argument);
}

TEST(FindBoard, FindsAChessboardBeforeABrightWindow) {
    CSimulatedRig rig(22);
    rig.pairs(1);
    cv::Mat picture = rig.picture(rig.boards()[0]);
    picture.forEach<std::uint8_t>([](std::uint8_t& g, const int*) {
        g = g == 120 ? 255 : static_cast<std::uint8_t>(g / 4);  // the wall behind becomes glaring
    });
    EXPECT_TRUE(findBoard(picture, rig.board()));
}

/// Dark squares of side 20 and gap 15, the first at (40, 30), seen askew.
struct TSquaresPicture {
    TBoard board;
    cv::Matx33d H{1, 0.1, 5, -0.05, 1.05, 30, 2e-4, 1e-4, 1};
    cv::Mat picture;

    explicit TSquaresPicture(double spread = 0) {
        board.pattern = EPattern::squares;
        board.columns = 6;
        board.rows = 4;
        board.square = 20;
        board.gap = 15;
        const int fine = 8;
        cv::Mat large(300 * fine, 400 * fine, CV_8U, cv::Scalar(230));
        for (int r = 0; r < board.rows; ++r)
            for (int c = 0; c < board.columns; ++c) {
                const double x = 40 + 35 * c - spread, y = 30 + 35 * r - spread;
                const double side = 20 + 2 * spread;
                large(
                    cv::Rect(cv::Point2d(fine * x, fine * y), cv::Size2d(fine * side, fine * side)))
                    .setTo(30);
            }
        // pixel centres: fine sample i lies at (i + 0.5) / fine - 0.5
        const double f = fine;
        const cv::Matx33d shrink(1 / f, 0, 0.5 / f - 0.5, 0, 1 / f, 0.5 / f - 0.5, 0, 0, 1);
        const cv::Matx33d grow(f, 0, (f - 1) / 2, 0, f, (f - 1) / 2, 0, 0, 1);
        cv::Mat seen;
        cv::warpPerspective(large, seen, grow * H * shrink, large.size(), cv::INTER_LINEAR,
                            cv::BORDER_CONSTANT, cv::Scalar(230));
        cv::resize(seen, picture, {400, 300}, 0, 0, cv::INTER_AREA);
    }

    /// Where the centre of a square is seen; edges of pixels lie half a pixel before their centres.
    TPoint2D centre(int column, int row) const {
        const cv::Vec3d q = H * cv::Vec3d(49.5 + 35 * column, 39.5 + 35 * row, 1);
        return {q[0] / q[2], q[1] / q[2]};
    }
};

TEST(FindBoard, FindsCentresOfSquaresRowByRow) {
    for (const double spread : {0.0, -1.5, 2.0}) {  // glare shrinks them, ink spreads
        const TSquaresPicture scene(spread);
        const auto found = findBoard(scene.picture, scene.board);
        ASSERT_TRUE(found) << spread;
        ASSERT_EQ(found->size(), 24u);
        for (int r = 0; r < 4; ++r)
            for (int c = 0; c < 6; ++c)
                EXPECT_LT(
                    distance((*found)[static_cast<std::size_t>(6 * r + c)], scene.centre(c, r)),
                    0.12)
                    << spread << " " << r << " " << c;
    }
}

TEST(FindBoard, FindsSquaresThatLieOnTheirSide) {
    const TSquaresPicture scene;
    cv::Mat turned;
    cv::rotate(scene.picture, turned, cv::ROTATE_90_CLOCKWISE);
    const auto found = findBoard(turned, scene.board);
    ASSERT_TRUE(found);
    // (u, v) of the picture lies at (rows - 1 - v, u) of the turned one
    const TPoint2D first = scene.centre(0, 0);
    EXPECT_LT(distance(found->front(), {scene.picture.rows - 1 - first.y, first.x}), 0.2);
}

TEST(FindBoard, FindsNoneWhereThereIsNone) {
    TBoard chess, squares;
    squares.pattern = EPattern::squares;
    squares.gap = 0.1;
    const cv::Mat empty(240, 320, CV_8U, cv::Scalar(90));
    cv::Mat noise(240, 320, CV_8U);
    cv::RNG(5).fill(noise, cv::RNG::UNIFORM, 0, 256);
    const cv::Mat tiny(3, 3, CV_8U, cv::Scalar(0));
    for (const cv::Mat& picture : {empty, noise, tiny}) {
        EXPECT_FALSE(findBoard(picture, chess));
        EXPECT_FALSE(findBoard(picture, squares));
    }
    const TSquaresPicture scene;
    auto other = scene.board;
    other.rows = 5;
    EXPECT_FALSE(findBoard(scene.picture, other)) << "a row too many";
    cv::Mat hidden = scene.picture.clone();
    hidden(cv::Rect(150, 100, 60, 60)).setTo(230);
    EXPECT_FALSE(findBoard(hidden, scene.board)) << "a part is hidden";
}

TEST(FindBoard, RefusesBoardsAndPicturesThatCannotBe) {
    const cv::Mat grey(50, 50, CV_8U, cv::Scalar(0));
    TBoard board;
    EXPECT_THROW(findBoard(cv::Mat(50, 50, CV_8UC3), board), std::invalid_argument);
    board.columns = 2;
    EXPECT_THROW(findBoard(grey, board), std::invalid_argument);
    board.columns = 9;
    for (const double side : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        board.square = side;
        EXPECT_THROW(findBoard(grey, board), std::invalid_argument);
    }
    board.square = 1;
    board.pattern = EPattern::squares;
    EXPECT_THROW(findBoard(grey, board), std::invalid_argument) << "no gap";
}

}  // namespace
}  // namespace salma::calibration
