// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/TSalientRegion.h>

namespace salma::saliency {

/// The points (x, y) with a (x-u)^2 + 2 b (x-u)(y-v) + c (y-v)^2 <= 1.
struct TEllipse {
    double u{0};  //!< Centre, column [px]; the centre of the first pixel is 0.
    double v{0};  //!< Centre, row [px].
    double a{1};  //!< [1/px^2]
    double b{0};  //!< [1/px^2]
    double c{1};  //!< [1/px^2]

    /// Radius of the disc with the ellipse's area [px].
    double radius() const;
};

/// The disc of a salient region. \throw std::invalid_argument if its scale is not positive.
TEllipse ellipseOf(const observations::TSalientRegion& region);

/** The filled ellipse that has the second moments [px^2] about (u, v); it is that of two standard
 * deviations. \throw std::invalid_argument if the moments are not positive definite. */
TEllipse ellipseOfMoments(double u, double v, const double (&moments)[3]);

}  // namespace salma::saliency
