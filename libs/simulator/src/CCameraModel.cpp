// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/CCameraModel.h>

#include <cmath>
#include <stdexcept>

namespace salma::simulator {

using Eigen::Vector2d;

CCameraModel::CCameraModel(const TCameraOptions& options) {
    options.validate();
    const double columns = options.columns(), rows = options.rows();
    const double fx = columns / 2 / std::tan(options.horizontalField / 2);
    m_camera.ncols = static_cast<std::uint32_t>(columns);
    m_camera.nrows = static_cast<std::uint32_t>(rows);
    m_camera.setIntrinsicParamsFromValues(fx, fx * options.pixelAspect, (columns - 1) / 2,
                                          (rows - 1) / 2);
    m_camera.setDistortionPlumbBob(options.k1, options.k2, options.p1, options.p2, options.k3);
    m_camera.focalLengthMeters = 0.0054;  // EVI-D30 at its widest
    m_camera.cameraName = "CAMERA";
    m_directions.reserve(std::size_t{m_camera.ncols} * m_camera.nrows);
    for (int y = 0; y < this->rows(); ++y)
        for (int x = 0; x < this->columns(); ++x) {
            const Vector2d direction = undistort(Vector2d(x, y));
            m_low = m_directions.empty() ? direction : m_low.cwiseMin(direction).eval();
            m_high = m_directions.empty() ? direction : m_high.cwiseMax(direction).eval();
            m_directions.push_back(direction.cast<float>());
        }
}

Vector2d CCameraModel::distort(const Vector2d& direction) const {
    const double x = direction.x(), y = direction.y(), r2 = direction.squaredNorm();
    const double radial = 1 + r2 * (m_camera.k1() + r2 * (m_camera.k2() + r2 * m_camera.k3()));
    const double xd = x * radial + 2 * m_camera.p1() * x * y + m_camera.p2() * (r2 + 2 * x * x);
    const double yd = y * radial + m_camera.p1() * (r2 + 2 * y * y) + 2 * m_camera.p2() * x * y;
    return {m_camera.fx() * xd + m_camera.cx(), m_camera.fy() * yd + m_camera.cy()};
}

Vector2d CCameraModel::undistort(const Vector2d& pixel) const {
    const Vector2d wanted((pixel.x() - m_camera.cx()) / m_camera.fx(),
                          (pixel.y() - m_camera.cy()) / m_camera.fy());
    Vector2d direction = wanted;
    for (int i = 0; i < 100; ++i) {  // fixed point: converges while the distortion is a correction
        const Vector2d seen = distort(direction);
        const Vector2d missing((pixel.x() - seen.x()) / m_camera.fx(),
                               (pixel.y() - seen.y()) / m_camera.fy());
        direction += missing;
        if (missing.squaredNorm() < 1e-24) return direction;
    }
    throw std::invalid_argument(
        "k1, k2, k3, p1, p2: this distortion folds over inside the picture");
}

std::optional<Vector2d> CCameraModel::project(const Eigen::Vector3d& point) const {
    if (!(point.z() > 1e-6)) return std::nullopt;
    const Vector2d direction = point.head<2>() / point.z();
    // far outside, the polynomial would fold back into the picture
    if (!((direction - m_low).minCoeff() >= -0.01 && (m_high - direction).minCoeff() >= -0.01))
        return std::nullopt;
    const Vector2d pixel = distort(direction);
    if (!(pixel.x() >= -0.5 && pixel.x() < columns() - 0.5 && pixel.y() >= -0.5 &&
          pixel.y() < rows() - 0.5))
        return std::nullopt;
    return pixel;
}

}  // namespace salma::simulator
