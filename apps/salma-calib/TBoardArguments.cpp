// SPDX-License-Identifier: BSD-3-Clause
#include "TBoardArguments.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "CProgressBar.h"
#include "readPicture.h"

namespace salma::apps {
namespace {

std::string asString(const cv::Size& size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

void TBoardArguments::addTo(CLI::App& command) {
    command.add_option("IMAGE", images, "pictures of the board, all of one size");
    command.add_option(
        "--board", size,
        "columns x rows of inner corners, e.g. 9x6; of squares with --pattern squares");
    command.add_option("--square-m,--square_m", board.square, "side of a square");
    command
        .add_option("--pattern", pattern, "chessboard (default), or squares apart from each other")
        ->check(CLI::IsMember({"chessboard", "squares"}));
    command.add_option("--gap-m", board.gap, "between two squares, with --pattern squares");
    command.add_flag("--allow-missing", allowMissing,
                     "leave out pictures without the board instead of failing");
}

void TBoardArguments::check() {
    if (images.empty()) throw CLI::RequiredError("IMAGE");
    if (size.empty()) throw CLI::RequiredError("--board");
    int used = 0;
    if (std::sscanf(size.c_str(), "%3dx%3d%n", &board.columns, &board.rows, &used) != 2 ||
        static_cast<std::size_t>(used) != size.size())
        throw CLI::ValidationError("--board", "'" + size + "' is not like 9x6");
    const bool squares = pattern == "squares";
    board.pattern = squares ? calibration::EPattern::squares : calibration::EPattern::chessboard;
    if (!squares && board.gap != 0)
        throw CLI::ValidationError("--gap-m", "is for --pattern squares only");
    try {
        board.validate();
    } catch (const std::invalid_argument& e) {
        throw CLI::ValidationError("--board, --square-m, --gap-m", e.what());
    }
}

TSeenBoards TBoardArguments::find() const {
    rejectEqualStems(images);
    TSeenBoards seen;
    CProgressBar progress("looking for boards", images.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
        cv::Mat grey = readGrey(images[i]);
        if (seen.size.empty()) seen.size = grey.size();
        if (grey.size() != seen.size)
            throw std::runtime_error(images[i] + ": is " + asString(grey.size()) + ", but " +
                                     images.front() + " is " + asString(seen.size));
        auto points = calibration::findBoard(grey, board);
        progress.step();
        if (!points) {
            seen.without.push_back(images[i]);
            continue;
        }
        seen.boards.push_back({images[i], std::move(grey), std::move(*points)});
        seen.indices.push_back(i);
    }
    if (!seen.without.empty() && !allowMissing) {
        std::string message = seen.without.front() + ": no board of " + size + " points";
        if (seen.without.size() > 1)
            message += ", nor in " + std::to_string(seen.without.size() - 1) + " others";
        throw std::runtime_error(message + " (--allow-missing leaves such pictures out)");
    }
    return seen;
}

}  // namespace salma::apps
