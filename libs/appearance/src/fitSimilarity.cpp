// SPDX-License-Identifier: BSD-3-Clause
#include "fitSimilarity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace salma::appearance {
namespace {

constexpr double kLeastSigma = 5e-4;  // nothing is placed better on a patch [m]

/// x_b as a linear function of (tx, ty, c, d) with c = scale cos, d = scale sin.
Eigen::Matrix<double, 2, 4> jacobian(const TPointPair& p) {
    Eigen::Matrix<double, 2, 4> J;
    J << 1, 0, p.ax, -p.ay, 0, 1, p.ay, p.ax;
    return J;
}

/** Variance of a coordinate about the best affine map: patches that are stretched wrongly, each in
 * its own way, still agree on one, and the noise of the single pairs is what is left.
 * \return Nothing for fewer than 6 pairs. */
std::optional<double> varianceAboutAffine(const std::vector<TPointPair>& pairs) {
    if (pairs.size() < 6) return std::nullopt;
    Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 3, 2> y = Eigen::Matrix<double, 3, 2>::Zero();
    for (const auto& p : pairs) {
        const Eigen::Vector3d x(1, p.ax, p.ay);
        N += x * x.transpose();
        y += x * Eigen::RowVector2d(p.bx, p.by);
    }
    const Eigen::Matrix<double, 3, 2> map = N.ldlt().solve(y);
    double squares = 0;
    for (const auto& p : pairs)
        squares += (Eigen::RowVector2d(p.bx, p.by) - Eigen::RowVector3d(1, p.ax, p.ay) * map)
                       .squaredNorm();
    return squares / static_cast<double>(2 * pairs.size() - 6);
}

}  // namespace

std::optional<TSimilarity> fitSimilarity(const std::vector<TPointPair>& pairs) {
    double ax = 0, ay = 0, bx = 0, by = 0;
    for (const auto& p : pairs) {
        ax += p.ax, ay += p.ay;
        bx += p.bx, by += p.by;
    }
    const auto n = static_cast<double>(pairs.size());
    ax /= n, ay /= n, bx /= n, by /= n;
    double dot = 0, cross = 0, spread = 0;
    for (const auto& p : pairs) {
        const double x = p.ax - ax, y = p.ay - ay, u = p.bx - bx, v = p.by - by;
        dot += x * u + y * v;
        cross += x * v - y * u;
        spread += x * x + y * y;
    }
    if (!(spread > 0) || !(std::hypot(dot, cross) > 0)) return std::nullopt;
    TSimilarity s;
    s.scale = std::hypot(dot, cross) / spread;
    s.rotation = std::atan2(cross, dot);
    const double c = s.scale * std::cos(s.rotation), d = s.scale * std::sin(s.rotation);
    s.tx = bx - c * ax + d * ay;
    s.ty = by - d * ax - c * ay;
    return s;
}

std::optional<TRelativePose> relativePose(const std::vector<TPointPair>& pairs) {
    if (pairs.size() < 3) return std::nullopt;
    const auto fitted = fitSimilarity(pairs);
    if (!fitted) return std::nullopt;
    const double c = fitted->scale * std::cos(fitted->rotation);
    const double d = fitted->scale * std::sin(fitted->rotation);
    Eigen::Matrix4d N = Eigen::Matrix4d::Zero();
    double squares = 0;
    for (const auto& p : pairs) {
        const auto J = jacobian(p);
        N += J.transpose() * J;
        squares += (Eigen::Vector2d(p.bx, p.by) - J * Eigen::Vector4d(fitted->tx, fitted->ty, c, d))
                       .squaredNorm();
    }
    const auto freedom = static_cast<double>(2 * pairs.size() - 4);
    const double spread = varianceAboutAffine(pairs).value_or(squares / freedom);
    const double variance = std::max(kLeastSigma * kLeastSigma, spread);
    Eigen::Matrix4d G = Eigen::Matrix4d::Identity();  // to (tx, ty, rotation, log scale)
    const double scale2 = fitted->scale * fitted->scale;
    G.bottomRightCorner<2, 2>() << -d / scale2, c / scale2, c / scale2, d / scale2;
    TRelativePose out;
    out.similarity = *fitted;
    out.covariance = G * (variance * N.inverse()) * G.transpose();
    out.pairs = pairs.size();
    if (!out.covariance.allFinite()) return std::nullopt;
    return out;
}

void addPatchErrors(const std::vector<TPointPair>& pairs,
                    const Eigen::Matrix3d& ofA,
                    const Eigen::Matrix3d& ofB,
                    TRelativePose& pose) {
    double x = 0, y = 0;
    const auto n = static_cast<double>(pairs.size());
    for (const auto& p : pairs) x += p.ax / n, y += p.ay / n;
    double xx = 0, xy = 0, yy = 0;
    for (const auto& p : pairs) {
        xx += (p.ax - x) * (p.ax - x);
        xy += (p.ax - x) * (p.ay - y);
        yy += (p.ay - y) * (p.ay - y);
    }
    const double all = xx + yy;
    // of (rotation, log scale) and of the middle of b, to (e_u, e_v, turn) of b; a's signs are
    // opposite
    const auto jacobianAround = [&](double mx, double my) {
        const Eigen::RowVector3d turn(-xy / all, xy / all, 1), scale(xx / all, yy / all, 0);
        Eigen::Matrix<double, 4, 3> J;
        J.row(0) = Eigen::RowVector3d(mx, 0, -my) - x * scale + y * turn;
        J.row(1) = Eigen::RowVector3d(0, my, mx) - y * scale - x * turn;
        J.row(2) = turn;
        J.row(3) = scale;
        return J;
    };
    const auto A = jacobianAround(x, y);
    const auto B = jacobianAround(x + pose.similarity.tx, y + pose.similarity.ty);
    pose.covariance += A * ofA * A.transpose() + B * ofB * B.transpose();
}

}  // namespace salma::appearance
