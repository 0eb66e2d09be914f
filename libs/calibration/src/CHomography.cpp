// SPDX-License-Identifier: BSD-3-Clause
#include <salma/calibration/CHomography.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace salma::calibration {
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

/// The same map of norm 1, positive at all of `points`; nothing if they lie on both sides of the
/// line that goes to infinity.
std::optional<Eigen::Matrix3d> oriented(Eigen::Matrix3d H, const std::vector<TPoint2D>& points) {
    H /= H.norm();
    if ((H * homogeneous(points[0])).z() < 0) H = -H;
    for (const auto& p : points)
        if (!((H * homogeneous(p)).z() > 0)) return std::nullopt;
    return H;
}

std::vector<cv::Point2d> asCv(const std::vector<TPoint2D>& points) {
    std::vector<cv::Point2d> converted;
    converted.reserve(points.size());
    for (const auto& p : points) converted.emplace_back(p.x, p.y);
    return converted;
}

std::vector<TPoint2D> chosen(const std::vector<TPoint2D>& points, const std::vector<bool>& which) {
    std::vector<TPoint2D> some;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (which[i]) some.push_back(points[i]);
    return some;
}

}  // namespace

void THomographyOptions::visit(config::COptionVisitor& v) {
    v.number("max_distance_px", maxDistance, config::moreThan(0),
             "farther from where it is mapped, a point is an outlier");
    v.number("confidence", confidence, config::insideOf(0, 1),
             "that a sample without outliers was drawn");
    v.integer("max_samples", maxSamples, config::between(1, 1e6), "at most so many are drawn");
    v.integer("min_inliers", minInliers, config::between(4, 1e6), "fewer are no map");
}

std::optional<CHomography> CHomography::through(const std::vector<TPoint2D>& from,
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
    const auto H = oriented(U.inverse() * normalised * T, from);
    if (!H) return std::nullopt;
    return CHomography(*H);
}

std::optional<TRobustHomography> CHomography::amongOutliers(const std::vector<TPoint2D>& from,
                                                            const std::vector<TPoint2D>& to,
                                                            const THomographyOptions& options) {
    options.validate();
    if (from.size() != to.size() || from.size() < 4 || !finite(from) || !finite(to))
        return std::nullopt;
    std::vector<unsigned char> mask;
    const cv::Mat found = cv::findHomography(asCv(from), asCv(to), cv::RANSAC, options.maxDistance,
                                             mask, options.maxSamples, options.confidence);
    if (found.empty()) return std::nullopt;
    Eigen::Matrix3d H;
    for (int i = 0; i < 9; ++i) H(i / 3, i % 3) = found.at<double>(i / 3, i % 3);
    TRobustHomography result{CHomography(H), std::vector<bool>(from.size()), 0};
    for (std::size_t i = 0; i < from.size(); ++i) {
        // OpenCV's mask is of before its refinement
        const TPoint2D miss = result.homography.map(from[i]) - to[i];
        result.inliers[i] = std::hypot(miss.x, miss.y) <= options.maxDistance;
        result.count += result.inliers[i] ? 1 : 0;
    }
    if (result.count < static_cast<std::size_t>(options.minInliers)) return std::nullopt;
    const auto inliers = chosen(from, result.inliers);
    if (!through(inliers, chosen(to, result.inliers))) return std::nullopt;  // degenerate
    const auto good = oriented(H, inliers);
    if (!good) return std::nullopt;
    result.homography = CHomography(*good);
    return result;
}

TPoint2D CHomography::map(const TPoint2D& point) const {
    const Eigen::Vector3d q = m_matrix * homogeneous(point);
    return {q.x() / q.z(), q.y() / q.z()};
}

}  // namespace salma::calibration
