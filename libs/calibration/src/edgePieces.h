// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "fitEdge.h"

namespace salma::calibration {

/// A straight piece of a linked edge.
struct TEdgePiece {
    std::vector<mrpt::math::TPoint2D> points;  //!< Without those near its ends [px].
    mrpt::math::TPoint2D ends[2];
    TImageLine line;

    double length() const { return (ends[1] - ends[0]).norm(); }
};

/// Edge pixels in order, from one end to the other. \param edges CV_8UC1, thin, not 0 on an edge.
std::vector<std::vector<cv::Point>> linkEdges(const cv::Mat& edges);

/// Cut where they bend by more than `bend` [px]; pieces shorter than `minLength` are dropped.
std::vector<TEdgePiece> straightPieces(const std::vector<std::vector<cv::Point>>& chains,
                                       double bend,
                                       double minLength);

}  // namespace salma::calibration
