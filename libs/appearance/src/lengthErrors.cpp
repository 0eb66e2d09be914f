// SPDX-License-Identifier: BSD-3-Clause
#include "lengthErrors.h"

#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/TPolarMeasurement.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace salma::appearance {

TLengthErrors lengthErrors(const observations::TPatch& patch) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const auto& pose = patch.pose;
    if (!(std::hypot(pose.mean.x(), pose.mean.y()) > 0)) return {kNone, kNone};
    const TPolarMeasurement m = polarMeasurement(patch);
    const double angle = m.full(1, 1) + m.full(2, 2) - 2 * m.full(1, 2);
    const double c = std::cos(m.wallAngle);
    const double s = std::sin(m.wallAngle);
    const auto& P = pose.cov;
    const double normal = c * c * P(0, 0) + 2 * c * s * P(0, 1) + s * s * P(1, 1);
    const double h = std::abs(c * pose.mean.x() + s * pose.mean.y());
    const double slant = std::tan(std::min(patch.incidence, 1.4));
    const double depth = normal / std::max(h * h, 0.01);
    return {4 * slant * slant * angle + depth, slant * slant * angle + depth};
}

Eigen::Matrix3d metricErrors(const observations::TPatch& patch) {
    const TPolarMeasurement m = polarMeasurement(patch);
    const double slant =
        std::tan(std::clamp(mrpt::math::wrapToPi(m.z[1] - m.wallAngle - M_PI), -1.4, 1.4));
    Eigen::Matrix<double, 2, 3> J;
    J << 1 / m.z[0], slant, -slant, 1 / m.z[0], 0, 0;
    Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
    out.topLeftCorner<2, 2>() = J * m.full * J.transpose();
    out(2, 2) = patch.pose.cov(4, 4);
    return out;
}

}  // namespace salma::appearance
