// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/simulator/CPath.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "seeds.h"

namespace salma::simulator {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr double kStep = 0.02;       // of the speed plan [m]
constexpr double kSwayLength = 7.3;  // no divisor of the lap: the next lap sways differently [m]
constexpr double kSwayStart = 3.0;   // the swaying grows from nothing over this [m]

[[noreturn]] void fail(const TPoint2D& p, const std::string& problem) {
    std::ostringstream text;
    text << "corner (" << p.x << ", " << p.y << ") " << problem;
    throw std::invalid_argument(text.str());
}

double direction(const TPoint2D& a, const TPoint2D& b) { return std::atan2(b.y - a.y, b.x - a.x); }

/// Pose after `d` metres along a line or arc that starts at `from`.
TPose2D advance(const TPose2D& from, double curvature, double d) {
    const double turn = curvature * d;
    // chord of the arc; the limit for a line is d
    const double chord = std::abs(turn) < 1e-9 ? d : std::sin(turn / 2) / (curvature / 2);
    return {from.x + chord * std::cos(from.phi + turn / 2),
            from.y + chord * std::sin(from.phi + turn / 2), from.phi + turn};
}

}  // namespace

CPath::CPath(const TPathOptions& options, std::uint32_t seed)
    : m_options(options), m_phase(CRandom(seed, "sway", 0).uniform(0, 2 * M_PI)) {
    m_options.validate();
    std::vector<TPoint2D> points;
    for (std::size_t i = 0; i < m_options.points.size(); i += 2)
        points.emplace_back(m_options.points[i], m_options.points[i + 1]);
    for (std::size_t i = 1; i < points.size(); ++i)
        if (!((points[i] - points[i - 1]).norm() > 1e-6)) fail(points[i], "stands twice in a row");
    addPieces(points);
    planSpeed();
}

void CPath::addPieces(const std::vector<TPoint2D>& points) {
    const std::size_t n = points.size();
    const std::size_t corners = m_options.closed ? n : n - 2;  // after the edge that leads there
    TPose2D at(points[0].x, points[0].y, direction(points[0], points[1]));
    double firstTangent = 0;
    std::size_t way = 0;  // that the piece belongs to; an arc to the way after it
    const auto add = [&](double length, double curvature) {
        const int floor =
            m_options.floors.empty() ? 1 : static_cast<int>(m_options.floors[way % n]);
        m_pieces.push_back({m_lapLength, length, curvature, at, floor});
        at = advance(at, curvature, length);
        m_lapLength += length;
    };
    if (m_options.closed) {  // start where the arc around the first point ends
        const double turn = mrpt::math::wrapToPi(at.phi - direction(points[n - 1], points[0]));
        firstTangent = m_options.cornerRadius * std::tan(std::abs(turn) / 2);
        at = advance(at, 0, firstTangent);
    }
    double before = firstTangent;
    for (std::size_t i = 1; i <= corners; ++i) {
        const TPoint2D& corner = points[i % n];
        const TPoint2D& next = points[(i + 1) % n];
        const double turn = mrpt::math::wrapToPi(direction(corner, next) - at.phi);
        const double tangent = m_options.cornerRadius * std::tan(std::abs(turn) / 2);
        const double straight = (corner - points[i - 1]).norm() - before - tangent;
        if (!(straight >= -1e-9)) fail(corner, "leaves no room for an arc of corner_radius_m");
        add(std::max(0.0, straight), 0);
        ++way;
        if (std::abs(turn) > 1e-9)
            add(std::abs(turn) * m_options.cornerRadius,
                std::copysign(1 / m_options.cornerRadius, turn));
        before = tangent;
    }
    if (!m_options.closed) add((points[n - 1] - points[n - 2]).norm() - before, 0);
}

const CPath::TPiece& CPath::pieceAt(double lapDistance) const {
    const auto next = std::upper_bound(m_pieces.begin() + 1, m_pieces.end(), lapDistance,
                                       [](double d, const TPiece& p) { return d < p.start; });
    return *(next - 1);
}

void CPath::planSpeed() {
    const double total = m_lapLength * m_options.laps;
    const auto steps = static_cast<std::size_t>(std::floor(total / kStep));
    m_speeds.resize(steps + 1);
    for (std::size_t i = 0; i <= steps; ++i) {
        const double d = std::fmod(static_cast<double>(i) * kStep, m_lapLength);
        const double curvature = std::abs(pieceAt(d).curvature);
        m_speeds[i] = std::min(m_options.speed, m_options.turnRate / std::max(curvature, 1e-9));
    }
    m_speeds.front() = m_speeds.back() = 0;
    const auto reach = [&](double v) {
        return std::sqrt(v * v + 2 * m_options.acceleration * kStep);
    };
    for (std::size_t i = 1; i <= steps; ++i)
        m_speeds[i] = std::min(m_speeds[i], reach(m_speeds[i - 1]));
    for (std::size_t i = steps; i > 0; --i)
        m_speeds[i - 1] = std::min(m_speeds[i - 1], reach(m_speeds[i]));
    m_times.assign(1, 0.0);
    for (std::size_t i = 1; i <= steps; ++i)
        m_times.push_back(m_times.back() + 2 * kStep / (m_speeds[i - 1] + m_speeds[i]));
}

double CPath::firstLapEnd() const {
    const auto step = static_cast<std::size_t>(m_lapLength / kStep);
    return m_times[std::min(step, m_times.size() - 1)];
}

double CPath::distance(double time) const {
    const double t = std::clamp(time, 0.0, duration());
    const auto next = std::upper_bound(m_times.begin() + 1, m_times.end() - 1, t);
    const auto i = static_cast<std::size_t>(next - m_times.begin()) - 1;
    const double whole = m_times[i + 1] - m_times[i];
    const double acceleration = (m_speeds[i + 1] - m_speeds[i]) / whole;
    const double part = t - m_times[i];
    return static_cast<double>(i) * kStep + part * (m_speeds[i] + acceleration * part / 2);
}

int CPath::lap(double time) const {
    const auto lap = static_cast<int>(distance(time) / m_lapLength) + 1;
    return std::min(lap, m_options.laps);
}

int CPath::floor(double time) const { return floorAt(std::fmod(distance(time), m_lapLength)); }

TPose2D CPath::beside(double distance, double aside) const {
    double lap = std::fmod(distance, m_lapLength);
    if (lap < 0) lap += m_lapLength;
    const TPiece& piece = pieceAt(lap);
    const TPose2D middle = advance(piece.from, piece.curvature, lap - piece.start);
    return {middle.x - aside * std::sin(middle.phi), middle.y + aside * std::cos(middle.phi),
            middle.phi};
}

TPose2D CPath::pose(double time) const {
    const double d = distance(time);
    const double lap = std::fmod(d, m_lapLength);
    const TPiece& piece = pieceAt(lap);
    const TPose2D middle = advance(piece.from, piece.curvature, lap - piece.start);
    const double omega = 2 * M_PI / kSwayLength;
    const double grown = std::min(1.0, d / kSwayStart);
    const double rise = grown < 1 ? 1 / kSwayStart : 0;
    // smooth step: starts and ends its growth without a kink in the heading
    const double size = m_options.wander * grown * grown * (3 - 2 * grown);
    const double sizeSlope = m_options.wander * 6 * grown * (1 - grown) * rise;
    const double sideways = size * std::sin(omega * d + m_phase);
    const double slope =
        sizeSlope * std::sin(omega * d + m_phase) + size * omega * std::cos(omega * d + m_phase);
    TPose2D pose(middle.x - sideways * std::sin(middle.phi),
                 middle.y + sideways * std::cos(middle.phi),
                 middle.phi + std::atan2(slope, 1 - piece.curvature * sideways));
    pose.phi = mrpt::math::wrapToPi(pose.phi);
    return pose;
}

}  // namespace salma::simulator
