// SPDX-License-Identifier: BSD-3-Clause
#include <salma/appearance/homography.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace salma::appearance {
namespace {

using mrpt::math::TPoint2D;

/// Smaller singular values (of normalised points, beside the largest) do not determine the map.
constexpr double kLeastSingular = 1e-6;

/// Brings points to mean 0 and mean distance sqrt 2; not finite if they lie in one place.
Eigen::Matrix3d normalisation(const std::vector<TPoint2D>& points) {
    const auto n = static_cast<double>(points.size());
    double x = 0, y = 0, distance = 0;
    for (const auto& p : points) x += p.x / n, y += p.y / n;
    for (const auto& p : points) distance += std::hypot(p.x - x, p.y - y) / n;
    const double scale = std::sqrt(2.0) / distance;
    Eigen::Matrix3d T;
    T << scale, 0, -scale * x, 0, scale, -scale * y, 0, 0, 1;
    return T;
}

Eigen::Vector3d homogeneous(const TPoint2D& p) { return {p.x, p.y, 1}; }

/// Two rows a pair: of Ho's three, the third follows from the others.
Eigen::MatrixXd equations(const std::vector<TPoint2D>& from,
                          const std::vector<TPoint2D>& to,
                          const Eigen::Matrix3d& T,
                          const Eigen::Matrix3d& U) {
    // At least nine rows, so that there is a singular vector for every singular value.
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(
        std::max<Eigen::Index>(9, 2 * static_cast<Eigen::Index>(from.size())), 9);
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Eigen::RowVector3d x = (T * homogeneous(from[i])).transpose();
        const Eigen::Vector3d y = U * homogeneous(to[i]);
        const auto row = 2 * static_cast<Eigen::Index>(i);
        A.block<1, 3>(row, 3) = -y.z() * x;
        A.block<1, 3>(row, 6) = y.y() * x;
        A.block<1, 3>(row + 1, 0) = y.z() * x;
        A.block<1, 3>(row + 1, 6) = -y.x() * x;
    }
    return A;
}

bool finite(const std::vector<TPoint2D>& points) {
    return std::all_of(points.begin(), points.end(),
                       [](const TPoint2D& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

bool invertible(const Eigen::Matrix3d& H) {
    const Eigen::Vector3d singular = H.jacobiSvd().singularValues();
    return singular[2] > kLeastSingular * singular[0];
}

}  // namespace

std::optional<Eigen::Matrix3d> homographyFrom(const std::vector<TPoint2D>& from,
                                              const std::vector<TPoint2D>& to) {
    if (from.size() != to.size() || from.size() < 4 || !finite(from) || !finite(to))
        return std::nullopt;
    const Eigen::Matrix3d T = normalisation(from), U = normalisation(to);
    if (!T.allFinite() || !U.allFinite()) return std::nullopt;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(equations(from, to, T, U), Eigen::ComputeFullV);
    const auto& singular = svd.singularValues();
    if (!(singular[7] > kLeastSingular * singular[0])) return std::nullopt;
    const Eigen::Matrix3d normalised =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
            Eigen::Matrix<double, 9, 1>(svd.matrixV().col(8)).eval().data());
    if (!invertible(normalised)) return std::nullopt;
    Eigen::Matrix3d H = U.inverse() * normalised * T;
    H /= H.norm();
    if ((H * homogeneous(from[0])).z() < 0) H = -H;
    for (const auto& p : from)  // all on one side of the line that goes to infinity
        if (!((H * homogeneous(p)).z() > 0)) return std::nullopt;
    return H;
}

cv::Mat rectifyQuad(const cv::Mat& grey,
                    const std::vector<TPoint2D>& corners,
                    const cv::Size& size) {
    if (grey.type() != CV_8UC1)
        throw std::invalid_argument("rectification needs a grey picture of 8 bits");
    if (size.width < 1 || size.height < 1)
        throw std::invalid_argument("rectification needs a size of at least one pixel");
    const double right = size.width - 0.5, bottom = size.height - 0.5;
    const auto H =
        homographyFrom({{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}, corners);
    if (!H || !(H->determinant() > 0)) return {};  // mirrored, or in another order
    cv::Matx33d map;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) map(r, c) = (*H)(r, c);
    cv::Mat out;
    cv::warpPerspective(grey, out, map, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                        cv::BORDER_REPLICATE);
    return out;
}

}  // namespace salma::appearance
