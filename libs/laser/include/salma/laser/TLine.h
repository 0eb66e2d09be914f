// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/poses/CPose2D.h>

#include <Eigen/Core>
#include <cstddef>

namespace salma::laser {

/// A straight piece of wall: x cos(alpha) + y sin(alpha) = rho, with rho >= 0.
struct TLine {
    double rho{0};    //!< Distance from the frame's origin [m].
    double alpha{0};  //!< Direction from the origin to the line's nearest point, (-pi, pi] [rad].
    Eigen::Matrix2d covariance{Eigen::Matrix2d::Zero()};  //!< Of (rho, alpha) [m, rad].
    mrpt::math::TPoint2D
        from;                 //!< End that comes first when the scan is read counter-clockwise [m].
    mrpt::math::TPoint2D to;  //!< The other end [m].
    std::size_t firstPoint{0};  //!< Index of the first scan point on it.
    std::size_t lastPoint{0};   //!< Index of the last.
    std::size_t points{0};      //!< Scan points that support it.

    double length() const { return (to - from).norm(); }
};

/// A point where two walls meet.
struct TCorner {
    mrpt::math::TPoint2D position;                        //!< [m]
    Eigen::Matrix2d covariance{Eigen::Matrix2d::Zero()};  //!< Of (x, y) [m^2].
    bool convex{
        false};  //!< True if the corner points towards the robot (a jamb), false for a nook.
};

/// The same line in another frame: `T_a_b` maps the frame b of `line` to the wanted frame a.
TLine transformed(const TLine& line, const mrpt::poses::CPose2D& T_a_b);

}  // namespace salma::laser
