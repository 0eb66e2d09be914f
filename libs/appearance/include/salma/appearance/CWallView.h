// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/poses/CPose3D.h>
#include <salma/laser/TLine.h>

#include <Eigen/Core>
#include <optional>
#include <utility>

namespace salma::appearance {

/** The geometry between one picture and one vertical wall.
 *
 * Wall coordinates: u [m] to the right as one faces the wall, 0 at the foot of the perpendicular
 * from the robot's origin; v [m] up, 0 at the height of the robot's origin. So a wall point is
 * X_r = p0 + u e_u + v e_v with p0 = rho (cos a, sin a, 0), e_u = (sin a, -cos a, 0),
 * e_v = (0, 0, 1). Pixels are those of the distorted picture; the first pixel's centre is (0, 0).
 * Source: K.-L. Ho, transfer report, Oxford 2004, section 4.5; lens: OpenCV's calib3d model. */
class CWallView {
 public:
    /** \param camera Pin-hole with MRPT's plumb_bob distortion or none.
     * \param T_r_c Camera on the robot; camera frame z forward, x right, y down.
     * \param wall In the robot frame, at the picture's time.
     * \throw std::invalid_argument if the camera has no focal length or a fish-eye lens, or if the
     * wall is not finite. */
    CWallView(const mrpt::img::TCamera& camera,
              const mrpt::poses::CPose3D& T_r_c,
              const laser::TLine& wall);

    /// Where the ray of a pixel meets the wall; nothing if it does not, or meets it from behind.
    std::optional<mrpt::math::TPoint2D> toWall(const mrpt::math::TPoint2D& pixel) const;

    /// Picture of a wall point, perhaps outside the picture; nothing if it lies behind the camera,
    /// beyond the lens model, or if the camera is behind the wall.
    std::optional<mrpt::math::TPoint2D> toPixel(double u, double v) const;

    /// True if the pixel lies in the picture and at least `margin` pixels from its border.
    bool inPicture(const mrpt::math::TPoint2D& pixel, double margin = 0) const;

    /// Angle between the ray from the camera to the wall point and the wall's normal [rad].
    double incidence(double u, double v) const;

    /// Resolution along u and along v [px/m]; zeros where toPixel() has nothing.
    std::pair<double, double> pixelsPerMetreOfAxes(double u, double v) const;
    /// The smaller of both.
    double pixelsPerMetre(double u, double v) const;

    /// u of the wall's two ends, the smaller first [m].
    std::pair<double, double> extent() const { return m_extent; }

    /// Wall metres (u, v, 1) to pixels of the undistorted camera: K [R e_u | R e_v | R p0 + t].
    Eigen::Matrix3d homography() const;

    /// Wall point in the robot frame [m].
    Eigen::Vector3d point(double u, double v) const;

    const mrpt::img::TCamera& camera() const { return m_camera; }
    const mrpt::poses::CPose3D& cameraPose() const { return m_T_r_c; }
    const laser::TLine& wall() const { return m_wall; }

 private:
    Eigen::Vector2d distorted(const Eigen::Vector2d& ray) const;
    std::optional<Eigen::Vector2d> undistorted(const Eigen::Vector2d& ray) const;
    double radial(double r2) const;
    double lensLimit() const;

    mrpt::img::TCamera m_camera;
    mrpt::poses::CPose3D m_T_r_c;
    laser::TLine m_wall;
    Eigen::Matrix3d m_R_r_c;           //!< Camera axes in the robot frame.
    Eigen::Vector3d m_t_r_c;           //!< Camera centre in the robot frame [m].
    Eigen::Vector3d m_p0, m_eu, m_ev;  //!< Of the wall, robot frame.
    Eigen::Matrix3d m_wallToRay;       //!< (u, v, 1) to camera coordinates.
    std::pair<double, double> m_extent{0, 0};
    bool m_distorts{false};
    bool m_inFront{false};   //!< The camera is on the robot's side of the wall.
    double m_maxRadius2{0};  //!< The lens model holds up to here [-].
};

}  // namespace salma::appearance
