// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CRectifier.h>
#include <salma/appearance/CWallView.h>

#include <opencv2/core.hpp>

namespace salma::landmarks {

/// A rectangle of a wall as seen from straight ahead, where the picture shows it.
struct TWallPicture {
    cv::Mat grey;   //!< CV_8UC1, first row at the top of the wall.
    cv::Mat valid;  //!< CV_8UC1, 0 where the wall point lies outside the source picture.
};

/** Samples a wall for looking at it, also beyond the picture's edge; CRectifier cuts patches.
 * Pixel (x, y) is the wall point (u0 + x / ppm.x, v1 - y / ppm.y). */
TWallPicture warpWall(const cv::Mat& grey,
                      const appearance::CWallView& view,
                      const appearance::TWallRectangle& area,
                      const cv::Point2d& pixelsPerMetre);

}  // namespace salma::landmarks
