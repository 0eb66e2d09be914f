// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace salma::calibration {

enum class EPattern {
    chessboard,  //!< Counted by its inner corners.
    squares      //!< Dark squares apart from each other, counted themselves.
};

/** A flat calibration pattern. Its frame b: origin at the first point, x along the first row, y
 * along the first column, so z points into the board as one faces it. */
struct TBoard {
    EPattern pattern{EPattern::chessboard};
    int columns{9};      //!< Inner corners, or squares, in a row; from 2.
    int rows{6};         //!< The same in a column; from 2.
    double square{0.1};  //!< [m] Side of a square.
    double gap{0};       //!< [m] Between two squares; of EPattern::squares only.

    /// The points that a picture shows [m], row by row: inner corners, or centres of squares (where
    /// the diagonals meet, which neither glare nor ink that spreads can move).
    std::vector<mrpt::math::TPoint2D> points() const;

    /// \throw std::invalid_argument naming the number that no board has.
    void validate() const;
};

/** Where a picture shows the points of a board [px], in the order of TBoard::points().
 *
 * A chessboard may be taken for itself turned by 180 degrees, where it looks the same.
 * \param grey CV_8UC1.
 * \return Nothing if the whole board is not there.
 * \throw std::invalid_argument for a picture of another type or a board that cannot be.
 * Source: A. Duda and U. Frese, "Accurate detection and localization of checkerboard corners",
 * BMVC 2018 (OpenCV's findChessboardCornersSB); squares: own. */
std::optional<std::vector<mrpt::math::TPoint2D>> findBoard(const cv::Mat& grey,
                                                           const TBoard& board);

/** Whether the square between the first two points of the first two rows of a chessboard is dark.
 * \param grey CV_8UC1. \param pixels As findBoard() found them. */
bool firstSquareIsDark(const cv::Mat& grey,
                       const TBoard& board,
                       const std::vector<mrpt::math::TPoint2D>& pixels);

}  // namespace salma::calibration
