// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

namespace salma::apps {

/// Errors of points in pictures [px]; `heldOut` may be empty.
struct TResidualPlot {
    cv::Size size;  //!< Of the pictures.
    std::vector<mrpt::math::TPoint2D> places, fitted, heldOut;
};

/** Draws the errors as a cloud, and as arrows where they were made, to a PNG of 1600 x 800.
 * \throw std::runtime_error if gnuplot is missing or fails, or the file cannot be written. */
void plotResiduals(const TResidualPlot& plot, const std::string& file);

/// Distances of the laser's points from one board [m]; `heldOut` may be empty.
struct TBoardDistances {
    std::string name;
    std::vector<double> fitted, heldOut;
};

/** Draws the distances board by board, and how often each occurs, to a PNG of 1600 x 800.
 * \throw std::runtime_error as plotResiduals(). */
void plotDistances(const std::vector<TBoardDistances>& boards, const std::string& file);

}  // namespace salma::apps
