// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace salma::calibration {

/// A line of a picture, normal.x u + normal.y v = distance [px], with a normal of length 1.
struct TImageLine {
    mrpt::math::TPoint2D normal;
    double distance{0};

    double offset(const mrpt::math::TPoint2D& p) const {
        return normal.x * p.x + normal.y * p.y - distance;
    }
};

/// Nothing for lines that are nearly parallel (below 5 degrees).
std::optional<mrpt::math::TPoint2D> intersection(const TImageLine& a, const TImageLine& b);

/** Least squares of the distances at right angles, with points farther than 3 standard deviations
 * (from the median distance) left out. Nothing for fewer than 4 points, or points in one place. */
std::optional<TImageLine> fitLine(const std::vector<mrpt::math::TPoint2D>& points);

/** The edge near the way from `from` to `to`, whose right side (as one goes) is the darker or the
 * brighter one all along. Its ends are left out, since other edges meet it there.
 * \param grey CV_8UC1. \return Nothing where fewer than half of the profiles show it. */
std::optional<TImageLine> fitEdge(const cv::Mat& grey,
                                  const mrpt::math::TPoint2D& from,
                                  const mrpt::math::TPoint2D& to);

}  // namespace salma::calibration
