// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CRectifier.h>
#include <salma/appearance/CWallView.h>

#include <opencv2/core/mat.hpp>

namespace salma::appearance {

/// A rectangle of a wall as one would see it from straight ahead.
struct TWallSample {
    cv::Mat grey;   //!< CV_8UC1, first row at the top of the wall.
    cv::Mat valid;  //!< CV_8UC1, 0 where the wall point lies outside the source picture.
};

/** Samples a rectangle on `size` pixels, each the mean over its area: no aliasing.
 * The middle of the first pixel lies half a pixel inside the rectangle. Beyond the picture's edge
 * the last pixels are repeated. */
TWallSample sampleWall(const cv::Mat& grey,
                       const CWallView& view,
                       const TWallRectangle& area,
                       const cv::Size& size);

}  // namespace salma::appearance
