// SPDX-License-Identifier: BSD-3-Clause
#include <salma/appearance/CWallView.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace salma::appearance {
namespace {

constexpr int kUndistortions = 20;
constexpr double kUndistorted = 1e-12;  // residual at which the inverse of the lens is exact [-]
constexpr double kNear = 0.01;          // nothing is seen nearer to the camera than this [m]
constexpr double kStep = 1e-4;          // of the central differences [m]

bool distorts(const mrpt::img::TCamera& camera) {
    return camera.distortion == mrpt::img::DistortionModel::plumb_bob &&
           std::any_of(camera.dist.begin(), camera.dist.end(), [](double k) { return k != 0; });
}

}  // namespace

CWallView::CWallView(const mrpt::img::TCamera& camera,
                     const mrpt::poses::CPose3D& T_r_c,
                     const laser::TLine& wall)
    : m_camera(camera), m_T_r_c(T_r_c), m_wall(wall), m_t_r_c(T_r_c.x(), T_r_c.y(), T_r_c.z()) {
    if (!(camera.fx() > 0 && camera.fy() > 0))
        throw std::invalid_argument("the camera has no focal length");
    if (camera.distortion == mrpt::img::DistortionModel::kannala_brandt)
        throw std::invalid_argument("a camera with a fish-eye lens is not supported");
    if (!std::isfinite(wall.rho + wall.alpha))
        throw std::invalid_argument("the wall line is not finite");
    const mrpt::math::CMatrixDouble33 R = T_r_c.getRotationMatrix();
    m_R_r_c = R.asEigen();
    const double c = std::cos(wall.alpha);
    const double s = std::sin(wall.alpha);
    m_p0 = {wall.rho * c, wall.rho * s, 0};
    m_eu = {s, -c, 0};
    m_ev = {0, 0, 1};
    m_wallToRay.col(0) = m_R_r_c.transpose() * m_eu;
    m_wallToRay.col(1) = m_R_r_c.transpose() * m_ev;
    m_wallToRay.col(2) = m_R_r_c.transpose() * (m_p0 - m_t_r_c);
    const double a = m_eu.x() * wall.from.x + m_eu.y() * wall.from.y;
    const double b = m_eu.x() * wall.to.x + m_eu.y() * wall.to.y;
    m_extent = {std::min(a, b), std::max(a, b)};
    m_distorts = distorts(m_camera);
    m_maxRadius2 = lensLimit();
    // in front of the wall, as the robot is
    m_inFront = m_t_r_c.x() * c + m_t_r_c.y() * s < wall.rho;
}

double CWallView::radial(double r2) const {
    const auto& k = m_camera.dist;  // k1 k2 p1 p2 k3 k4 k5 k6
    return (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) /
           (1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
}

/// Farther out the radial polynomial folds back, and a point beside the picture would appear in it.
double CWallView::lensLimit() const {
    constexpr double kFarthest = 10;  // tangent of 84 deg
    constexpr double kRadiusStep = 0.005;
    if (!m_distorts) return std::numeric_limits<double>::infinity();
    double before = 0;
    double r = kRadiusStep;
    for (; r < kFarthest; r += kRadiusStep) {
        const double now = r * radial(r * r);
        if (!(now > before)) break;
        before = now;
    }
    r -= kRadiusStep;
    return r * r;
}

Eigen::Vector2d CWallView::distorted(const Eigen::Vector2d& ray) const {
    if (!m_distorts) return ray;
    const double x = ray.x();
    const double y = ray.y();
    const double p1 = m_camera.dist[2];
    const double p2 = m_camera.dist[3];
    const double r2 = x * x + y * y;
    const double f = radial(r2);
    return {x * f + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
            y * f + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

std::optional<Eigen::Vector2d> CWallView::undistorted(const Eigen::Vector2d& ray) const {
    Eigen::Vector2d p = ray;
    for (int i = 0; i < kUndistortions; ++i) {  // Newton with a numerical Jacobian
        const Eigen::Vector2d residual = distorted(p) - ray;
        if (residual.norm() < kUndistorted) break;
        constexpr double h = 1e-6;
        Eigen::Matrix2d J;
        J.col(0) = (distorted(p + Eigen::Vector2d(h, 0)) - distorted(p - Eigen::Vector2d(h, 0)));
        J.col(1) = (distorted(p + Eigen::Vector2d(0, h)) - distorted(p - Eigen::Vector2d(0, h)));
        p -= 2 * h * (J.inverse() * residual);
    }
    if (!((distorted(p) - ray).norm() < 1e-9) || !(p.squaredNorm() <= m_maxRadius2))
        return std::nullopt;
    return p;
}

std::optional<mrpt::math::TPoint2D> CWallView::toWall(const mrpt::math::TPoint2D& pixel) const {
    const auto ray = undistorted(
        {(pixel.x - m_camera.cx()) / m_camera.fx(), (pixel.y - m_camera.cy()) / m_camera.fy()});
    if (!ray || !m_inFront) return std::nullopt;
    const Eigen::Vector3d d = m_R_r_c * Eigen::Vector3d(ray->x(), ray->y(), 1);
    const Eigen::Vector3d n(std::cos(m_wall.alpha), std::sin(m_wall.alpha), 0);
    const double towards = n.dot(d);
    if (!(towards > 1e-9)) return std::nullopt;
    const double t = (m_wall.rho - n.dot(m_t_r_c)) / towards;
    const Eigen::Vector3d X = m_t_r_c + t * d;
    return mrpt::math::TPoint2D(m_eu.dot(X - m_p0), X.z());
}

std::optional<mrpt::math::TPoint2D> CWallView::toPixel(double u, double v) const {
    const Eigen::Vector3d X = m_wallToRay * Eigen::Vector3d(u, v, 1);
    if (!m_inFront || !(X.z() > kNear)) return std::nullopt;
    const Eigen::Vector2d ray = X.head<2>() / X.z();
    if (!(ray.squaredNorm() <= m_maxRadius2)) return std::nullopt;
    const Eigen::Vector2d p = distorted(ray);
    return mrpt::math::TPoint2D(m_camera.fx() * p.x() + m_camera.cx(),
                                m_camera.fy() * p.y() + m_camera.cy());
}

bool CWallView::inPicture(const mrpt::math::TPoint2D& pixel, double margin) const {
    return pixel.x >= margin && pixel.x <= m_camera.ncols - 1.0 - margin && pixel.y >= margin &&
           pixel.y <= m_camera.nrows - 1.0 - margin;
}

double CWallView::incidence(double u, double v) const {
    const Eigen::Vector3d ray = point(u, v) - m_t_r_c;
    const Eigen::Vector3d n(std::cos(m_wall.alpha), std::sin(m_wall.alpha), 0);
    return std::acos(std::clamp(std::abs(n.dot(ray)) / ray.norm(), 0.0, 1.0));
}

std::pair<double, double> CWallView::pixelsPerMetreOfAxes(double u, double v) const {
    const auto left = toPixel(u - kStep, v);
    const auto right = toPixel(u + kStep, v);
    const auto below = toPixel(u, v - kStep);
    const auto above = toPixel(u, v + kStep);
    if (!left || !right || !below || !above) return {0, 0};
    return {(*right - *left).norm() / (2 * kStep), (*above - *below).norm() / (2 * kStep)};
}

double CWallView::pixelsPerMetre(double u, double v) const {
    const auto both = pixelsPerMetreOfAxes(u, v);
    return std::min(both.first, both.second);
}

Eigen::Matrix3d CWallView::homography() const {
    Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
    K(0, 0) = m_camera.fx();
    K(1, 1) = m_camera.fy();
    K(0, 2) = m_camera.cx();
    K(1, 2) = m_camera.cy();
    return K * m_wallToRay;
}

Eigen::Vector3d CWallView::point(double u, double v) const { return m_p0 + u * m_eu + v * m_ev; }

}  // namespace salma::appearance
