// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <opencv2/core/mat.hpp>
#include <vector>

namespace salma::appearance {

/** A quadrilateral of a picture as an upright rectangle: rectification without a laser, where four
 * corners are known.
 * \param grey CV_8UC1, without lens distortion.
 * \param corners Top left, top right, bottom right, bottom left [px].
 * \param size Of the result [px]; the corners become the outer edges of its corner pixels.
 * \return Empty if the corners are no convex quadrilateral in this order.
 * \throw std::invalid_argument if `grey` is of another type or `size` is empty. */
cv::Mat rectifyQuad(const cv::Mat& grey,
                    const std::vector<mrpt::math::TPoint2D>& corners,
                    const cv::Size& size);

}  // namespace salma::appearance
