// SPDX-License-Identifier: BSD-3-Clause
#include <salma/calibration/TBoard.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "findSquares.h"

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;

constexpr int kLeastSide = 16;  ///< [px] OpenCV's finders stumble over smaller pictures.

/// Side of the window in which a corner is refined: half the way to the next corner, or less.
int halfWindow(const std::vector<cv::Point2f>& corners, int columns) {
    double nearest = 1e9;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if ((i + 1) % static_cast<std::size_t>(columns) != 0)
            nearest = std::min(nearest, cv::norm(corners[i + 1] - corners[i]));
        const std::size_t below = i + static_cast<std::size_t>(columns);
        if (below < corners.size())
            nearest = std::min(nearest, cv::norm(corners[below] - corners[i]));
    }
    return std::clamp(static_cast<int>(nearest / 2) - 1, 2, 11);
}

/// Grey levels above `level` made one, so that a window behind the board does not hide its
/// contrast.
cv::Mat clipped(const cv::Mat& grey, int level) {
    cv::Mat picture;
    cv::min(grey, level, picture);
    picture.convertTo(picture, CV_8U, 255.0 / level);
    return picture;
}

/// The older finder copes with a few pictures that the newer one does not.
bool findByQuads(const cv::Mat& grey, const cv::Size& size, std::vector<cv::Point2f>& corners) {
    cv::Mat even;
    cv::createCLAHE(4, {8, 8})->apply(grey, even);
    const int flags = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE;
    if (!cv::findChessboardCorners(grey, size, corners, flags) &&
        !cv::findChessboardCorners(even, size, corners, cv::CALIB_CB_ADAPTIVE_THRESH))
        return false;
    const int half = halfWindow(corners, size.width);
    const cv::TermCriteria criteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-3);
    cv::cornerSubPix(grey, corners, {half, half}, {-1, -1}, criteria);
    return true;
}

std::optional<std::vector<TPoint2D>> findChessboard(const cv::Mat& grey, const TBoard& board) {
    std::vector<cv::Point2f> corners;
    const cv::Size size(board.columns, board.rows);
    const int plain = cv::CALIB_CB_ACCURACY | cv::CALIB_CB_EXHAUSTIVE;
    if (!cv::findChessboardCornersSB(grey, size, corners, plain | cv::CALIB_CB_NORMALIZE_IMAGE) &&
        !cv::findChessboardCornersSB(clipped(grey, 160), size, corners, plain) &&
        !cv::findChessboardCornersSB(clipped(grey, 110), size, corners, plain) &&
        !findByQuads(grey, size, corners))
        return std::nullopt;
    std::vector<TPoint2D> points;
    points.reserve(corners.size());
    for (const auto& p : corners) points.emplace_back(p.x, p.y);
    return points;
}

}  // namespace

std::vector<TPoint2D> TBoard::points() const {
    std::vector<TPoint2D> all;
    const double step = square + (pattern == EPattern::squares ? gap : 0);
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) all.emplace_back(c * step, r * step);
    return all;
}

void TBoard::validate() const {
    const int least = pattern == EPattern::chessboard ? 3 : 2;  // OpenCV's finder needs three
    if (columns < least || rows < least || columns > 100 || rows > 100)
        throw std::invalid_argument("a board of " + std::to_string(columns) + "x" +
                                    std::to_string(rows) + " points: from " +
                                    std::to_string(least) + " to 100 each are possible");
    if (!(square > 0) || !std::isfinite(square))
        throw std::invalid_argument("a board needs squares larger than 0 m");
    if (pattern == EPattern::squares && (!(gap > 0) || !std::isfinite(gap)))
        throw std::invalid_argument("squares apart from each other need a gap larger than 0 m");
}

std::optional<std::vector<TPoint2D>> findBoard(const cv::Mat& grey, const TBoard& board) {
    if (grey.type() != CV_8UC1)
        throw std::invalid_argument("a board is looked for in a grey picture of 8 bits");
    board.validate();
    if (std::min(grey.cols, grey.rows) < kLeastSide) return std::nullopt;
    return board.pattern == EPattern::chessboard ? findChessboard(grey, board)
                                                 : findSquares(grey, board);
}

bool firstSquareIsDark(const cv::Mat& grey,
                       const TBoard& board,
                       const std::vector<TPoint2D>& pixels) {
    if (grey.type() != CV_8UC1 || pixels.size() != board.points().size())
        throw std::invalid_argument("needs a grey picture and all points of its board");
    double sums[2] = {0, 0}, counts[2] = {0, 0};
    for (int r = 0; r + 1 < board.rows; ++r)
        for (int c = 0; c + 1 < board.columns; ++c) {
            const auto first = static_cast<std::size_t>(r * board.columns + c);
            const auto below = first + static_cast<std::size_t>(board.columns);
            const TPoint2D middle =
                (pixels[first] + pixels[first + 1] + pixels[below] + pixels[below + 1]) * 0.25;
            const cv::Point at(cvRound(middle.x), cvRound(middle.y));
            if (!cv::Rect(0, 0, grey.cols, grey.rows).contains(at)) continue;
            sums[(r + c) % 2] += grey.at<unsigned char>(at);
            counts[(r + c) % 2] += 1;
        }
    return sums[0] * counts[1] < sums[1] * counts[0];
}

}  // namespace salma::calibration
