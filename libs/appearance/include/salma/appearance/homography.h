// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace salma::appearance {

/** The homography that maps the points `from` to the points `to`, by the direct linear transform.
 *
 * Both sets are normalised (centred, mean distance sqrt 2); the solution is the right singular
 * vector of the smallest singular value. With four pairs it is exact, with more it minimises the
 * algebraic error: for pairs with outliers use cv::findHomography.
 * \param from, to Any unit; of the same length, 4 or more.
 * \return Scaled to norm 1, of positive last coordinate at the points. Nothing for fewer or unequal
 * numbers of points, for points that are not finite, and where the points do not determine an
 * invertible map: three of four on a line, all on a line or in one place, or sides that cross so
 * that the map would tear the quadrilateral apart.
 * Source: R. Hartley and A. Zisserman, "Multiple View Geometry", 2nd ed., algorithm 4.2; K.-L. Ho,
 * transfer report, Oxford 2004, equation 4.7. */
std::optional<Eigen::Matrix3d> homographyFrom(const std::vector<mrpt::math::TPoint2D>& from,
                                              const std::vector<mrpt::math::TPoint2D>& to);

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
