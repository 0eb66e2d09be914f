// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <utility>
#include <vector>

namespace salma::slam {

/// A point moved by T = (x, y, turn).
Eigen::Vector2d applied(const Eigen::Vector3d& T, const Eigen::Vector2d& point);

/// A pose moved by T.
Eigen::Vector3d appliedToPose(const Eigen::Vector3d& T, const Eigen::Vector3d& pose);

Eigen::Vector3d inverseOf(const Eigen::Vector3d& T);

/// T done to a share of it: the same screw about the same centre.
Eigen::Vector3d shareOf(const Eigen::Vector3d& T, double share);

/// The motion that brings the first points nearest to the second, in the least squares sense; two
/// pairs at least. Source: Horn, JOSA A 4(4), 1987, in the plane.
Eigen::Vector3d fitted(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& pairs);

}  // namespace salma::slam
