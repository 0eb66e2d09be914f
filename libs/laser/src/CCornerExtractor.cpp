// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/laser/CCornerExtractor.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace salma::laser {
namespace {

Eigen::Vector2d asVector(const mrpt::math::TPoint2D& p) { return {p.x, p.y}; }

/// Intersection of two lines that are not parallel, with covariance from both.
TCorner intersect(const TLine& a, const TLine& b) {
    Eigen::Matrix2d A;
    A << std::cos(a.alpha), std::sin(a.alpha), std::cos(b.alpha), std::sin(b.alpha);
    const Eigen::Matrix2d inverse = A.inverse();
    const Eigen::Vector2d p = inverse * Eigen::Vector2d(a.rho, b.rho);
    TCorner corner;
    corner.position = {p.x(), p.y()};
    for (int i = 0; i < 2; ++i) {
        // A p = rho, so dp/drho_i = A^-1 e_i and dp/dalpha_i = A^-1 e_i (p x n_i)
        Eigen::Matrix2d J;
        J.col(0) = inverse.col(i);
        J.col(1) = inverse.col(i) * (A(i, 1) * p.x() - A(i, 0) * p.y());
        corner.covariance += J * (i == 0 ? a : b).covariance * J.transpose();
    }
    return corner;
}

/// Beams between the end of one line and the start of the other; scans may run either way.
std::size_t beamsBetween(const TLine& a, const TLine& b) {
    if (b.firstPoint > a.lastPoint) return b.firstPoint - a.lastPoint - 1;
    if (a.firstPoint > b.lastPoint) return a.firstPoint - b.lastPoint - 1;
    return 0;
}

/// Distance between neighbouring beams' ends on a line at a point [m].
double spacing(const TLine& line, const Eigen::Vector2d& p, const TLineResult& scan) {
    const Eigen::Vector2d ray = p - asVector(scan.sensor);
    const double facing = std::abs(ray.x() * std::cos(line.alpha) + ray.y() * std::sin(line.alpha));
    return scan.beamStep * ray.squaredNorm() / std::max(facing, 1e-6);
}

double bearing(const Eigen::Vector2d& p, const TLineResult& scan) {
    return std::atan2(p.y() - scan.sensor.y, p.x() - scan.sensor.x);
}

/// Both ends reach the corner, and it is seen between them: otherwise one wall hides the other's.
bool endsMeet(const TLine& a, const TLine& b, const TLineResult& scan, const TCornerOptions& o) {
    if (beamsBetween(a, b) > static_cast<std::size_t>(o.maxMissingBeams)) return false;
    const Eigen::Vector2d p = asVector(intersect(a, b).position);
    const auto reaches = [&](const TLine& line, const Eigen::Vector2d& end) {
        const double limit = std::min(o.maxEndDistance, o.endTolerance + spacing(line, p, scan));
        return (end - p).norm() <= limit;
    };
    const Eigen::Vector2d to = asVector(a.to);
    const Eigen::Vector2d from = asVector(b.from);
    if (!reaches(a, to) || !reaches(b, from)) return false;
    const double slack = 2 * scan.beamStep;
    return mrpt::math::wrapToPi(bearing(p, scan) - bearing(to, scan)) >= -slack &&
           mrpt::math::wrapToPi(bearing(from, scan) - bearing(p, scan)) >= -slack;
}

bool supported(const TLine& a, const TLine& b, const TCornerOptions& o) {
    return std::max(a.length(), b.length()) >= o.longSide &&
           std::min(a.points, b.points) >= static_cast<std::size_t>(o.shortSidePoints);
}

/// Largest standard deviation in any direction [m].
double largestSigma(const Eigen::Matrix2d& covariance) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance, Eigen::EigenvaluesOnly);
    return std::sqrt(eigen.eigenvalues()[1]);
}

/** Variance of the edge's place along its wall [m^2]: it lies anywhere between two beams, and the
 * noise of the last one moves it. */
double edgeVariance(double step,
                    const Eigen::Vector2d& ray,
                    double along,
                    const TLineResult& scan) {
    const double turned = scan.beamStep > 0 ? step * scan.bearingSigma / scan.beamStep : 0;
    const double pushed = scan.rangeSigma * along / ray.norm();
    return step * step / 12 + turned * turned + pushed * pushed;
}

/// The edge of a wall: between its last point and the beam that passes it.
TCorner edgeOf(const TLine& line, const mrpt::math::TPoint2D& end, const TLineResult& scan) {
    const Eigen::Vector2d last = asVector(end);
    const Eigen::Vector2d outward =
        (2 * last - asVector(line.from) - asVector(line.to)).normalized();
    const double step = spacing(line, last, scan);
    const Eigen::Vector2d p = last + 0.5 * step * outward;
    const Eigen::Vector2d normal(std::cos(line.alpha), std::sin(line.alpha));
    const Eigen::Vector2d ray = last - asVector(scan.sensor);
    const Eigen::Vector2d J(1, p.x() * normal.y() - p.y() * normal.x());
    TCorner corner;
    corner.position = {p.x(), p.y()};
    corner.convex = true;
    corner.covariance =
        edgeVariance(step, ray, ray.dot(outward), scan) * outward * outward.transpose() +
        J.dot(line.covariance * J) * normal * normal.transpose();
    return corner;
}

}  // namespace

void TCornerOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.degrees("min_angle_deg", minAngle, between(5, 90), "walls that meet at less are no corner");
    v.number("end_tolerance_m", endTolerance, moreThan(0),
             "a wall's end is this near to the corner, beside one beam spacing");
    v.number("max_end_distance_m", maxEndDistance, moreThan(0), "limit of that sum");
    v.integer("max_missing_beams", maxMissingBeams, atLeast(0), "beams between the two ends");
    v.number("long_side_m", longSide, moreThan(0), "one of the two walls is at least this long");
    v.integer("short_side_points", shortSidePoints, atLeast(3),
              "each wall has at least this many points");
    v.flag("line_ends", lineEnds, "also edges of walls before a depth jump");
    v.number("max_sigma_m", maxSigma, moreThan(0), "less certain corners are refused");
    v.number("sigma_floor_m", sigmaFloor, atLeast(0), "added in quadrature to the covariance");
}

void TCornerOptions::validate() const {
    if (!(sigmaFloor < maxSigma))
        throw std::invalid_argument("[corners] sigma_floor_m must be below max_sigma_m");
    if (!(endTolerance <= maxEndDistance))
        throw std::invalid_argument(
            "[corners] end_tolerance_m must not be above max_end_distance_m");
}

CCornerExtractor::CCornerExtractor(const TCornerOptions& options) : m_options(options) {
    m_options.validate();
}

void CCornerExtractor::add(TCorner corner, TCornerResult& result) const {
    corner.covariance += m_options.sigmaFloor * m_options.sigmaFloor * Eigen::Matrix2d::Identity();
    if (largestSigma(corner.covariance) <= m_options.maxSigma)
        result.corners.push_back(corner);
    else
        ++result.refusedUncertain;
}

void CCornerExtractor::addLineEnds(const TLineResult& lines, TCornerResult& result) const {
    for (std::size_t i = 0; i < lines.lines.size(); ++i) {
        const TLine& line = lines.lines[i];
        if (!(line.length() >= m_options.longSide)) continue;
        for (const bool first : {true, false}) {
            if (!(first ? lines.freeEnds[i].from : lines.freeEnds[i].to)) continue;
            const TCorner edge = edgeOf(line, first ? line.from : line.to, lines);
            const auto isSame = [&](const TCorner& c) {
                return c.convex && (c.position - edge.position).norm() <= m_options.maxEndDistance;
            };
            const auto& known = result.corners;
            if (std::none_of(known.begin(), known.end(), isSame)) add(edge, result);
        }
    }
}

TCornerResult CCornerExtractor::extract(const TLineResult& lines) const {
    TCornerResult result;
    for (std::size_t i = 1; i < lines.lines.size(); ++i) {
        const TLine& a = lines.lines[i - 1];
        const TLine& b = lines.lines[i];
        if (!(std::abs(std::sin(b.alpha - a.alpha)) >= std::sin(m_options.minAngle))) {
            ++result.refusedAngle;
        } else if (!endsMeet(a, b, lines, m_options)) {
            ++result.refusedApart;
        } else if (!supported(a, b, m_options)) {
            ++result.refusedSupport;
        } else {
            TCorner corner = intersect(a, b);
            // walked counter-clockwise, with the robot on the left, the way turns right at an edge
            const mrpt::math::TPoint2D before = a.to - a.from;
            const mrpt::math::TPoint2D after = b.to - b.from;
            corner.convex = before.x * after.y - before.y * after.x < 0;
            add(corner, result);
        }
    }
    if (m_options.lineEnds) addLineEnds(lines, result);
    return result;
}

}  // namespace salma::laser
