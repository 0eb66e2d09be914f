// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>
#include <salma/simulator/TSensorOptions.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace salma::simulator {

/** A pinhole with the plumb-bob distortion of MRPT and OpenCV. Pixel centres are at integers; the
 * optical frame c has z forward, x right and y down. */
class CCameraModel {
 public:
    /// \throw std::invalid_argument if the distortion folds over inside the picture.
    explicit CCameraModel(const TCameraOptions& options);

    const mrpt::img::TCamera& parameters() const { return m_camera; }
    int columns() const { return static_cast<int>(m_camera.ncols); }
    int rows() const { return static_cast<int>(m_camera.nrows); }

    /// Pixel of the direction (x/z, y/z), which may lie outside the picture.
    Eigen::Vector2d distort(const Eigen::Vector2d& direction) const;

    /// Direction (x/z, y/z) of a pixel: the inverse of distort().
    Eigen::Vector2d undistort(const Eigen::Vector2d& pixel) const;

    /// Pixel of a point in the camera frame [m]; nothing if it is behind or outside the picture.
    std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;

    /// undistort() of all pixels, row by row.
    const std::vector<Eigen::Vector2f>& directions() const { return m_directions; }

 private:
    mrpt::img::TCamera m_camera;
    std::vector<Eigen::Vector2f> m_directions;
    Eigen::Vector2d m_low{0, 0}, m_high{0, 0};  //!< Bounds of all directions.
};

}  // namespace salma::simulator
