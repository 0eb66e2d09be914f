// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <salma/calibration/CCameraMatrix.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

/// Smaller singular values (of normalised points, beside the largest) do not determine the camera.
constexpr double kLeastSingular = 1e-5;

bool finite(const TSpacePoint& p) {
    return std::isfinite(p.world.x) && std::isfinite(p.world.y) && std::isfinite(p.world.z) &&
           std::isfinite(p.pixel.x) && std::isfinite(p.pixel.y);
}

/// Points as columns of homogeneous vectors.
Eigen::MatrixXd worldOf(const std::vector<TSpacePoint>& points) {
    Eigen::MatrixXd all(4, static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
        all.col(static_cast<Eigen::Index>(i)) << points[i].world.x, points[i].world.y,
            points[i].world.z, 1;
    return all;
}

Eigen::MatrixXd pictureOf(const std::vector<TSpacePoint>& points) {
    Eigen::MatrixXd all(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
        all.col(static_cast<Eigen::Index>(i)) << points[i].pixel.x, points[i].pixel.y, 1;
    return all;
}

/// Brings points to mean 0 and mean distance sqrt(dimension).
Eigen::MatrixXd normalisation(const Eigen::MatrixXd& points) {
    const Eigen::Index d = points.rows() - 1;
    const Eigen::VectorXd mean = points.topRows(d).rowwise().mean();
    const double distance = (points.topRows(d).colwise() - mean).colwise().norm().mean();
    Eigen::MatrixXd T = Eigen::MatrixXd::Identity(d + 1, d + 1);
    T.topLeftCorner(d, d) *= std::sqrt(static_cast<double>(d)) / distance;
    T.topRightCorner(d, 1) = -T(0, 0) * mean;
    return T;
}

/// M = K R with K upper triangular of positive diagonal: QR of the inverse.
void decompose(const Eigen::Matrix3d& M, Eigen::Matrix3d& K, Eigen::Matrix3d& R) {
    const Eigen::HouseholderQR<Eigen::Matrix3d> qr(M.inverse().eval());
    const Eigen::Matrix3d Q = qr.householderQ();
    const Eigen::Matrix3d U = qr.matrixQR().triangularView<Eigen::Upper>();
    Eigen::Matrix3d signs = Eigen::Matrix3d::Identity();
    for (int i = 0; i < 3; ++i) signs(i, i) = U(i, i) < 0 ? -1 : 1;
    K = (signs * U).inverse();
    R = (Q * signs).transpose();
    K /= K(2, 2);
}

/// fx, fy, skew, cx, cy, rotation vector, t
using TParameters = std::array<double, 11>;

struct TPointCost {
    const TSpacePoint& point;

    template <typename T>
    bool operator()(const T* c, T* residual) const {
        const T world[3] = {T(point.world.x), T(point.world.y), T(point.world.z)};
        T X[3];
        ceres::AngleAxisRotatePoint(c + 5, world, X);
        for (int i = 0; i < 3; ++i) X[i] += c[8 + i];
        const T x = X[0] / X[2], y = X[1] / X[2];
        residual[0] = c[0] * x + c[2] * y + c[3] - T(point.pixel.x);
        residual[1] = c[1] * y + c[4] - T(point.pixel.y);
        return true;
    }
};

}  // namespace

std::optional<CCameraMatrix> CCameraMatrix::through(const std::vector<TSpacePoint>& points) {
    if (points.size() < 6 || !std::all_of(points.begin(), points.end(), finite))
        return std::nullopt;
    const Eigen::MatrixXd X = worldOf(points), x = pictureOf(points);
    const Eigen::MatrixXd U = normalisation(X), T = normalisation(x);
    if (!U.allFinite() || !T.allFinite()) return std::nullopt;
    const Eigen::MatrixXd Xn = U * X, xn = T * x;
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * X.cols(), 12);
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        A.block<1, 4>(2 * i, 4) = -Xn.col(i).transpose();
        A.block<1, 4>(2 * i, 8) = xn(1, i) * Xn.col(i).transpose();
        A.block<1, 4>(2 * i + 1, 0) = Xn.col(i).transpose();
        A.block<1, 4>(2 * i + 1, 8) = -xn(0, i) * Xn.col(i).transpose();
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
    if (!(svd.singularValues()[10] > kLeastSingular * svd.singularValues()[0])) return std::nullopt;
    const Eigen::VectorXd p = svd.matrixV().col(11);
    Eigen::Matrix<double, 3, 4> normalised;
    normalised << p.segment<4>(0).transpose(), p.segment<4>(4).transpose(),
        p.segment<4>(8).transpose();
    Eigen::Matrix<double, 3, 4> P = T.inverse() * normalised * U;
    if ((P.row(2) * X.col(0))(0) < 0) P = -P;
    const Eigen::Matrix3d M = P.leftCols<3>();
    // Mirrored, or with points on both sides of the camera: no camera took such a picture.
    if (!(M.determinant() > 0) || !((P.row(2) * X).minCoeff() > 0)) return std::nullopt;
    Eigen::Matrix3d K, R;
    decompose(M, K, R);
    const double scale = (K * R).norm() / M.norm();
    const Eigen::Vector3d t = K.inverse() * P.col(3) * scale;
    if (!K.allFinite() || !R.allFinite() || !t.allFinite()) return std::nullopt;
    return CCameraMatrix(K, R, t);
}

CCameraMatrix CCameraMatrix::refined(const std::vector<TSpacePoint>& points) const {
    TParameters c{m_K(0, 0), m_K(1, 1), m_K(0, 1), m_K(0, 2), m_K(1, 2)};
    ceres::RotationMatrixToAngleAxis(m_R.data(), c.data() + 5);
    for (int i = 0; i < 3; ++i) c[static_cast<std::size_t>(8 + i)] = m_t[i];
    std::vector<double> misses;
    for (const auto& p : points) misses.push_back((project(p.world) - p.pixel).norm());
    const auto middle = misses.begin() + static_cast<std::ptrdiff_t>(misses.size() / 2);
    std::nth_element(misses.begin(), middle, misses.end());
    ceres::Problem problem;
    for (const auto& p : points)
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<TPointCost, 2, 11>(new TPointCost{p}),
            new ceres::HuberLoss(std::max(1e-6, 3 * *middle)), c.data());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 200;
    options.function_tolerance = 1e-12;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable() || !(c[0] > 0) || !(c[1] > 0))
        throw std::runtime_error("the fit of the camera matrix does not converge");
    Eigen::Matrix3d K, R;
    K << c[0], c[2], c[3], 0, c[1], c[4], 0, 0, 1;
    ceres::AngleAxisToRotationMatrix(c.data() + 5, R.data());
    return {K, R, Eigen::Vector3d(c[8], c[9], c[10])};
}

Eigen::Matrix<double, 3, 4> CCameraMatrix::P() const {
    Eigen::Matrix<double, 3, 4> P;
    P << m_K * m_R, m_K * m_t;
    return P;
}

TPoint2D CCameraMatrix::project(const TPoint3D& world) const {
    const Eigen::Vector3d x = m_K * (m_R * Eigen::Vector3d(world.x, world.y, world.z) + m_t);
    return {x.x() / x.z(), x.y() / x.z()};
}

double CCameraMatrix::rms(const std::vector<TSpacePoint>& points) const {
    double squares = 0;
    for (const auto& p : points) squares += (project(p.world) - p.pixel).sqrNorm();
    return std::sqrt(squares / static_cast<double>(points.size()));
}

}  // namespace salma::calibration
