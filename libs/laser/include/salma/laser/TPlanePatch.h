// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace salma::laser {

/// What a plane is, by how it lies and by what is beside it.
enum class EPlaneKind {
    wall,        //!< Upright, and nothing higher close behind it.
    protrusion,  //!< Upright, and a wall close behind it rises above it: a heater, a cupboard.
    floor,       //!< Level and below the scanner.
    ceiling,     //!< Level and above the scanner.
    other        //!< Neither upright nor level.
};

/// A piece of a plane: normal . p = distance, distance >= 0 as seen from the robot frame's origin.
struct TPlanePatch {
    EPlaneKind kind{EPlaneKind::other};
    Eigen::Vector3d normal{1, 0, 0};  //!< Unit vector.
    double distance{0};               //!< [m]
    /// Axes in the plane: `across` is level (or along x on a level plane), `up` = normal x across.
    Eigen::Vector3d across{0, 1, 0}, up{0, 0, 1};
    /// Of (a, b, distance): the normal is normal + a across + b up [rad, rad, m].
    Eigen::Matrix3d covariance{Eigen::Matrix3d::Zero()};
    /// The rectangle along `across` and `up` that holds all its points, from the origin's foot [m].
    Eigen::Vector2d low{0, 0}, high{0, 0};
    std::size_t scans{0};   //!< Scans that see it.
    std::size_t lines{0};   //!< Their lines on it.
    std::size_t points{0};  //!< Points of these lines.

    Eigen::Vector2d size() const { return high - low; }
};

}  // namespace salma::laser
