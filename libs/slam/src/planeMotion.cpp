// SPDX-License-Identifier: BSD-3-Clause
#include "planeMotion.h"

#include <mrpt/math/wrap2pi.h>

#include <Eigen/LU>
#include <cmath>

namespace salma::slam {

Eigen::Vector2d applied(const Eigen::Vector3d& T, const Eigen::Vector2d& point) {
    return T.head<2>() + Eigen::Rotation2Dd(T[2]) * point;
}

Eigen::Vector3d appliedToPose(const Eigen::Vector3d& T, const Eigen::Vector3d& pose) {
    Eigen::Vector3d result;
    result << applied(T, pose.head<2>()), mrpt::math::wrapToPi(pose[2] + T[2]);
    return result;
}

Eigen::Vector3d inverseOf(const Eigen::Vector3d& T) {
    Eigen::Vector3d result;
    result << -(Eigen::Rotation2Dd(-T[2]) * T.head<2>()), -T[2];
    return result;
}

Eigen::Vector3d shareOf(const Eigen::Vector3d& T, double share) {
    Eigen::Vector3d result = share * T;
    if (std::abs(T[2]) < 1e-6) return result;
    const Eigen::Matrix2d away =
        Eigen::Matrix2d::Identity() - Eigen::Rotation2Dd(T[2]).toRotationMatrix();
    const Eigen::Vector2d centre = away.inverse() * T.head<2>();
    result.head<2>() = centre - Eigen::Rotation2Dd(share * T[2]) * centre;
    return result;
}

Eigen::Vector3d fitted(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& pairs) {
    Eigen::Vector2d from(0, 0), to(0, 0);
    for (const auto& [a, b] : pairs) {
        from += a / static_cast<double>(pairs.size());
        to += b / static_cast<double>(pairs.size());
    }
    double along = 0, across = 0;
    for (const auto& [a, b] : pairs) {
        const Eigen::Vector2d p = a - from, q = b - to;
        along += p.dot(q);
        across += p.x() * q.y() - p.y() * q.x();
    }
    Eigen::Vector3d T;
    T[2] = std::atan2(across, along);
    T.head<2>() = to - Eigen::Rotation2Dd(T[2]) * from;
    return T;
}

}  // namespace salma::slam
