// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/calibration/TBoard.h>

namespace salma::calibration {

/// findBoard() for EPattern::squares.
std::optional<std::vector<mrpt::math::TPoint2D>> findSquares(const cv::Mat& grey,
                                                             const TBoard& board);

}  // namespace salma::calibration
