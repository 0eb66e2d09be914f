// SPDX-License-Identifier: BSD-3-Clause
#include "CPlaneSearch.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace salma::laser {
namespace {

constexpr int kRegrowths = 4;
constexpr int kIterations = 3;
constexpr double kLevel = 0.9;       // |z| of a normal from which `across` is taken along x
constexpr double kLeastView = 0.1;   // of a plane to the scanner [m]
constexpr double kLeastSpan = 0.05;  // two lines nearer than this tell no plane [m]

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Axes in the plane, as TPlanePatch has them.
void setAxes(TPlanePatch& plane) {
    const Vector3d z = Vector3d::UnitZ();
    const Vector3d x = Vector3d::UnitX();
    plane.across = std::abs(plane.normal.z()) < kLevel
                       ? z.cross(plane.normal).normalized()
                       : (x - x.dot(plane.normal) * plane.normal).normalized();
    plane.up = plane.normal.cross(plane.across);
}

TPlaneFit outwards(const Vector3d& normal, double distance) {
    if (distance < 0) return {-normal, -distance};
    return {normal, distance};
}

/// An interval on one axis of a plane.
struct TSpan {
    double low, high;
    double gapTo(const TSpan& other) const {
        return std::max(low, other.low) - std::min(high, other.high);
    }
};

TSpan spanOf(const TSpaceLine& line, const Vector3d& axis) {
    const auto [low, high] = std::minmax({axis.dot(line.from), axis.dot(line.to)});
    return {low, high};
}

}  // namespace

CPlaneSearch::CPlaneSearch(const TPlaneOptions& options, const std::vector<TSpaceLine>& lines)
    : m_options(options),
      m_lines(lines),
      m_free(lines.size(), 1),
      m_random(static_cast<std::uint32_t>(options.seed)) {
    for (std::size_t i = 0; i < lines.size(); ++i)
        while (m_firstOfScan.size() <= lines[i].scan) m_firstOfScan.push_back(i);
    m_firstOfScan.push_back(lines.size());
}

std::size_t CPlaneSearch::freeLines() const {
    return static_cast<std::size_t>(std::count(m_free.begin(), m_free.end(), 1));
}

bool CPlaneSearch::lies(const TPlaneFit& fit, std::size_t line) const {
    return std::abs(fit.offset(m_lines[line].from)) <= m_options.inlier &&
           std::abs(fit.offset(m_lines[line].to)) <= m_options.inlier;
}

std::size_t CPlaneSearch::support(const TPlaneFit& fit) const {
    std::size_t points = 0;
    for (std::size_t i = 0; i < m_lines.size(); ++i)
        if (m_free[i] && lies(fit, i)) points += m_lines[i].points.size();
    return points;
}

std::optional<TPlaneFit> CPlaneSearch::draw(std::size_t i) {
    const TSpaceLine& line = m_lines[i];
    const std::size_t last =
        std::min(line.scan + static_cast<std::size_t>(m_options.window), m_firstOfScan.size() - 2);
    const std::size_t begin = m_firstOfScan[line.scan + 1], end = m_firstOfScan[last + 1];
    if (line.scan + 1 > last || begin == end) return std::nullopt;
    const std::size_t j = begin + m_random() % (end - begin);
    if (!m_free[j]) return std::nullopt;
    const Vector3d along = line.to - line.from;
    const Vector3d middle = 0.5 * (m_lines[j].from + m_lines[j].to);
    const Vector3d cross = along.cross(middle - line.from);
    if (!(cross.norm() > kLeastSpan * along.norm())) return std::nullopt;
    const Vector3d normal = cross.normalized();
    const TPlaneFit fit = outwards(normal, normal.dot(line.from));
    // a plane through the scanner would be seen edge-on: it is that of a scan, not of a surface
    if (!(std::abs(fit.offset(line.scanner)) >= kLeastView) || !lies(fit, j)) return std::nullopt;
    return fit;
}

/// Buildings repeat their directions, so a line too short to tell its own plane may lie on one
/// parallel to a plane already found: a window frame, a door in its recess.
std::optional<TPlaneFit> CPlaneSearch::drawParallel(std::size_t i) {
    if (m_normals.empty()) return std::nullopt;
    const TSpaceLine& line = m_lines[i];
    const Vector3d& normal = m_normals[m_random() % m_normals.size()];
    const TPlaneFit fit = outwards(normal, normal.dot(0.5 * (line.from + line.to)));
    if (!(std::abs(fit.offset(line.scanner)) >= kLeastView) || !lies(fit, i)) return std::nullopt;
    return fit;
}

std::optional<TPlaneFit> CPlaneSearch::bestHypothesis() {
    Indices candidates;
    for (std::size_t i = 0; i < m_lines.size(); ++i)
        if (m_free[i]) candidates.push_back(i);
    std::optional<TPlaneFit> best;
    std::size_t most = 0;
    const auto samples = static_cast<std::size_t>(m_options.hypotheses);
    for (std::size_t h = 0; h < samples && !candidates.empty(); ++h) {
        const std::size_t line = candidates[h * candidates.size() / samples];
        const auto fit = h % 2 == 0 ? draw(line) : drawParallel(line);
        if (!fit) continue;
        const std::size_t points = support(*fit);
        if (points <= most) continue;
        most = points;
        best = fit;
    }
    return best;
}

CPlaneSearch::Indices CPlaneSearch::gather(const TPlaneFit& fit) const {
    TPlanePatch axes;
    axes.normal = fit.normal;
    setAxes(axes);
    Indices on;
    std::vector<TSpan> across, up;
    for (std::size_t i = 0; i < m_lines.size(); ++i) {
        if (!m_free[i] || !lies(fit, i)) continue;
        on.push_back(i);
        across.push_back(spanOf(m_lines[i], axes.across));
        up.push_back(spanOf(m_lines[i], axes.up));
    }
    std::vector<char> seen(on.size(), 0);
    Indices best;
    std::size_t most = 0;
    for (std::size_t start = 0; start < on.size(); ++start) {
        if (seen[start]) continue;
        Indices piece{start};  // grows while it is walked through
        std::size_t points = 0;
        seen[start] = 1;
        for (std::size_t k = 0; k < piece.size(); ++k) {
            const std::size_t a = piece[k];
            points += m_lines[on[a]].points.size();
            for (std::size_t b = 0; b < on.size(); ++b)
                if (!seen[b] && across[a].gapTo(across[b]) <= m_options.gap &&
                    up[a].gapTo(up[b]) <= m_options.gap) {
                    seen[b] = 1;
                    piece.push_back(b);
                }
        }
        if (points <= most) continue;
        most = points;
        best.clear();
        for (const std::size_t k : piece) best.push_back(on[k]);
    }
    std::sort(best.begin(), best.end());
    return best;
}

std::optional<TPlanePatch> CPlaneSearch::refine(const TPlaneFit& start,
                                                const Indices& members) const {
    TPlanePatch plane;
    plane.normal = start.normal;
    plane.distance = start.distance;
    const double range2 = m_options.rangeSigma * m_options.rangeSigma;
    const double bearing2 = m_options.bearingSigma * m_options.bearingSigma;
    for (int iteration = 0; iteration <= kIterations; ++iteration) {
        setAxes(plane);
        Matrix3d N = Matrix3d::Zero();
        Vector3d g = Vector3d::Zero();
        double chi2 = 0;
        plane.points = 0;
        for (const std::size_t i : members)
            for (const Vector3d& p : m_lines[i].points) {
                const double d = plane.normal.dot(p) - plane.distance;
                if (!(std::abs(d) <= m_options.inlier)) continue;
                const Vector3d ray = p - m_lines[i].scanner;
                const double facing = plane.normal.dot(ray) / ray.norm();
                const double weight =
                    1 /
                    (facing * facing * range2 +
                     (1 - std::min(1.0, facing * facing)) * ray.squaredNorm() * bearing2 + 1e-12);
                const Vector3d J(plane.across.dot(p), plane.up.dot(p), -1);
                N += weight * J * J.transpose();
                g += weight * d * J;
                chi2 += weight * d * d;
                ++plane.points;
            }
        const Eigen::LDLT<Matrix3d> factor(N);
        if (plane.points < 4 || factor.info() != Eigen::Success || !factor.isPositive() ||
            !(factor.vectorD().minCoeff() > 0))
            return std::nullopt;
        if (iteration == kIterations) {
            plane.covariance = factor.solve(Matrix3d::Identity()) *
                               std::max(1.0, chi2 / static_cast<double>(plane.points - 3));
            break;
        }
        const Vector3d step = factor.solve(-g);
        const Vector3d normal = plane.normal + step[0] * plane.across + step[1] * plane.up;
        const TPlaneFit fit = outwards(normal.normalized(), plane.distance + step[2]);
        if (!std::isfinite(fit.distance) || !fit.normal.allFinite()) return std::nullopt;
        plane.normal = fit.normal;
        plane.distance = fit.distance;
    }
    return plane;
}

std::optional<TPlanePatch> CPlaneSearch::next() {
    for (;;) {
        const auto hypothesis = bestHypothesis();
        if (!hypothesis) return std::nullopt;
        Indices members = gather(*hypothesis);
        TPlaneFit fit = *hypothesis;
        std::optional<TPlanePatch> plane;
        for (int i = 0; i < kRegrowths; ++i) {
            const auto better = refine(fit, members);
            if (!better) break;
            plane = better;
            fit = {better->normal, better->distance};
            const Indices regrown = gather(fit);
            if (regrown.size() < members.size() / 2 || regrown == members) break;
            members = regrown;
        }
        for (const std::size_t i : members) m_free[i] = 0;
        if (members.empty()) return std::nullopt;
        if (!plane || !(std::abs(fit.offset(m_lines[members.front()].scanner)) >= kLeastView))
            continue;
        plane->lines = members.size();
        plane->low.setConstant(1e9);
        plane->high.setConstant(-1e9);
        std::size_t scan = m_lines.size();  // of no line
        for (const std::size_t i : members) {
            plane->scans += i == members.front() || m_lines[i].scan != scan;
            scan = m_lines[i].scan;
            for (const Vector3d& p : m_lines[i].points) {
                const Eigen::Vector2d at(plane->across.dot(p), plane->up.dot(p));
                plane->low = plane->low.cwiseMin(at);
                plane->high = plane->high.cwiseMax(at);
            }
        }
        const bool large = plane->lines >= static_cast<std::size_t>(m_options.minLines) &&
                           plane->points >= static_cast<std::size_t>(m_options.minPoints) &&
                           plane->size().minCoeff() >= m_options.minSize && plane->scans > 1;
        if (!large) continue;
        m_normals.push_back(plane->normal);
        return plane;
    }
}

}  // namespace salma::laser
