// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/TEllipse.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace salma::saliency {

double TEllipse::radius() const { return std::pow(a * c - b * b, -0.25); }

TEllipse ellipseOf(const observations::TSalientRegion& region) {
    if (!(region.s > 0))
        throw std::invalid_argument("a region's scale must be positive, got " +
                                    std::to_string(region.s));
    const double a = 1 / (region.s * region.s);
    return {region.x, region.y, a, 0, a};
}

TEllipse ellipseOfMoments(double u, double v, const double (&moments)[3]) {
    const auto [xx, xy, yy] = moments;
    const double determinant = xx * yy - xy * xy;
    if (!(xx > 0 && determinant > 0))
        throw std::invalid_argument("second moments of a region are not positive definite");
    const double k = 1 / (4 * determinant);
    return {u, v, k * yy, -k * xy, k * xx};
}

}  // namespace salma::saliency
