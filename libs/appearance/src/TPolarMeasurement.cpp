// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/TPolarMeasurement.h>

#include <cmath>
#include <stdexcept>

namespace salma::appearance {

TPolarMeasurement polarMeasurement(const observations::TPatch& patch) {
    const mrpt::poses::CPose3D& pose = patch.pose.mean;
    const double x = pose.x();
    const double y = pose.y();
    const double range = std::hypot(x, y);
    if (!(range > 0)) throw std::invalid_argument("a patch lies at the robot's origin");
    Eigen::Matrix3d P;  // of (x, y, yaw)
    const int rows[] = {0, 1, 3};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) P(i, j) = patch.pose.cov(rows[i], rows[j]);
    Eigen::Matrix3d J;
    J << x / range, y / range, 0, -y / (range * range), x / (range * range), 0, 0, 0, 1;
    TPolarMeasurement out;
    out.full = J * P * J.transpose();
    out.z = {range, std::atan2(y, x)};
    out.R = out.full.topLeftCorner<2, 2>();
    out.wallAngle = mrpt::math::wrapToPi(pose.yaw() - M_PI_2);
    out.wallAngleSigma = std::sqrt(out.full(2, 2));
    return out;
}

}  // namespace salma::appearance
