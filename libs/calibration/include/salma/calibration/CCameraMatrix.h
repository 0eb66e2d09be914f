// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPoint3D.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace salma::calibration {

/// A point of the world and where a picture shows it.
struct TSpacePoint {
    mrpt::math::TPoint3D world;  //!< [m]
    mrpt::math::TPoint2D pixel;  //!< [px]
};

/** Points of a text file, `x y z u v` a line [m times `scale`, px], blanks or commas between; empty
 * lines and lines that begin with # are passed over.
 * \param scale Metres of the file's unit of length.
 * \throw std::runtime_error naming file, line and value. */
std::vector<TSpacePoint> readPoints(const std::string& file, double scale = 1);

/** A camera without distortion, x = K [R | t] X: eleven numbers from points in space. */
class CCameraMatrix {
 public:
    /** The direct linear transform, both sets normalised; from six points on.
     * \return Nothing for fewer points, points that are not finite, and points that determine no
     * camera: all in one plane or on one line, or seen from behind.
     * Source: R. Hartley and A. Zisserman, "Multiple View Geometry", 2nd ed., algorithm 7.1 (linear
     * part). */
    static std::optional<CCameraMatrix> through(const std::vector<TSpacePoint>& points);

    /// Least squares of the distances in the picture, from here on (Ceres, Huber's loss beyond 3
    /// median absolute residuals). \throw std::runtime_error if it does not converge.
    CCameraMatrix refined(const std::vector<TSpacePoint>& points) const;

    /// Upper triangular, positive diagonal, K(2, 2) = 1 [px].
    const Eigen::Matrix3d& K() const { return m_K; }
    /// World to camera.
    const Eigen::Matrix3d& R() const { return m_R; }
    const Eigen::Vector3d& t() const { return m_t; }  //!< [m]
    Eigen::Matrix<double, 3, 4> P() const;

    mrpt::math::TPoint2D project(const mrpt::math::TPoint3D& world) const;
    /// Root of the mean squared distance [px].
    double rms(const std::vector<TSpacePoint>& points) const;

 private:
    CCameraMatrix(const Eigen::Matrix3d& K, const Eigen::Matrix3d& R, const Eigen::Vector3d& t)
        : m_K(K), m_R(R), m_t(t) {}

    Eigen::Matrix3d m_K, m_R;
    Eigen::Vector3d m_t;
};

}  // namespace salma::calibration
