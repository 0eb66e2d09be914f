// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/calibration/TBoard.h>

#include <CLI/CLI.hpp>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace salma::apps {

/// A picture and the board in it.
struct TSeenBoard {
    std::string file;
    cv::Mat grey;                              //!< CV_8UC1
    std::vector<mrpt::math::TPoint2D> pixels;  //!< In the order of TBoard::points() [px].
};

/// Pictures that show a board, and those that do not.
struct TSeenBoards {
    std::vector<TSeenBoard> boards;    //!< In the order of the pictures.
    std::vector<std::size_t> indices;  //!< Of each, among the pictures that were given.
    std::vector<std::string> without;  //!< Files in which no board was found.
    cv::Size size;                     //!< Of all pictures [px].
};

/// What the commands are told about the board and its pictures.
struct TBoardArguments {
    std::vector<std::string> images;
    std::string size;  //!< "9x6"
    calibration::TBoard board;
    std::string pattern{"chessboard"};
    bool allowMissing{false};

    void addTo(CLI::App& command);
    /// What CLI11 does not check itself; fills `board`. \throw CLI::ParseError
    void check();

    /** Looks for the board in all pictures.
     * \throw std::runtime_error naming the files that cannot be read, are of another size than the
     * first, stand twice, or (unless allowed) show no board. */
    TSeenBoards find() const;
};

}  // namespace salma::apps
