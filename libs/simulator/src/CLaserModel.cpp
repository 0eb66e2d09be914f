// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/simulator/CLaserModel.h>

#include <cmath>
#include <limits>
#include <utility>

#include "seeds.h"

namespace salma::simulator {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kNothing = static_cast<std::size_t>(-1);
constexpr double kMixStep = 0.05;  // smaller steps inside a beam are no edge [m]

double cross(const TPoint2D& a, const TPoint2D& b) { return a.x * b.y - a.y * b.x; }

/// Distance to the segment along a unit direction; infinity if it is missed.
double distanceTo(const TSegment& s, const TPoint2D& from, const TPoint2D& direction) {
    const TPoint2D edge = s.to - s.from, start = s.from - from;
    const double across = cross(direction, edge);
    if (std::abs(across) < 1e-12) return kInfinity;
    const double distance = cross(start, edge) / across;
    const double along = cross(start, direction) / across;
    const double slack = 1e-9;  // no gap where two segments meet
    const bool inside = along >= -slack && along <= 1 + slack;
    if (!(distance > 0 && inside)) return kInfinity;
    return distance;
}

}  // namespace

CLaserModel::CLaserModel(const TLaserOptions& options, const CWorld& world, std::uint32_t seed)
    : CLaserModel(options, world.segmentsAt(options.z), seed) {}

CLaserModel::CLaserModel(const TLaserOptions& options,
                         std::vector<TSegment> segments,
                         std::uint32_t seed)
    : m_options(options),
      m_segments(std::move(segments)),
      m_seed(seed),
      m_offset(CRandom(seed, "laser offset", 0).uniform(-options.maxOffset, options.maxOffset)) {
    m_options.validate();
}

CLaserModel CLaserModel::with(const std::vector<TSegment>& obstacles) const {
    CLaserModel model = *this;
    model.m_segments.insert(model.m_segments.end(), obstacles.begin(), obstacles.end());
    return model;
}

TPose2D CLaserModel::laserPose(const TPose2D& T_w_r) const {
    return {T_w_r.x + m_options.x * std::cos(T_w_r.phi),
            T_w_r.y + m_options.x * std::sin(T_w_r.phi), T_w_r.phi};
}

double CLaserModel::castOne(const TPoint2D& from, double angle) const {
    double nearest = kInfinity;
    for (const auto& s : m_segments)
        nearest = std::min(nearest, distanceTo(s, from, {std::cos(angle), std::sin(angle)}));
    return nearest;
}

std::vector<CLaserModel::THit> CLaserModel::castAll(const TPose2D& T_w_l) const {
    const double step = m_options.resolutionAngle(), start = -m_options.apertureAngle() / 2;
    const auto last = static_cast<double>(m_options.beams() - 1);
    std::vector<THit> hits(m_options.beams(), {kInfinity, kNothing});
    const TPoint2D origin(T_w_l.x, T_w_l.y);
    for (std::size_t i = 0; i < m_segments.size(); ++i) {
        const TPoint2D a = m_segments[i].from - origin, b = m_segments[i].to - origin;
        const double bearing = std::atan2(a.y, a.x) - T_w_l.phi;
        const double width = mrpt::math::wrapToPi(std::atan2(b.y, b.x) - T_w_l.phi - bearing);
        const double low = mrpt::math::wrapToPi(bearing + std::min(0.0, width));
        for (const double turn : {0.0, -2 * M_PI}) {  // the interval may pass the half turn
            const double from = std::max(0.0, std::floor((low + turn - start) / step));
            const double to =
                std::min(last, std::ceil((low + turn + std::abs(width) - start) / step));
            for (double k = from; k <= to; ++k) {
                const double angle = T_w_l.phi + start + k * step;
                const double range =
                    distanceTo(m_segments[i], origin, {std::cos(angle), std::sin(angle)});
                THit& hit = hits[static_cast<std::size_t>(k)];
                if (range < hit.range) hit = {range, i};
            }
        }
    }
    return hits;
}

std::vector<double> CLaserModel::trueRanges(const TPose2D& T_w_r) const {
    std::vector<double> ranges;
    for (const THit& hit : castAll(laserPose(T_w_r))) ranges.push_back(hit.range);
    return ranges;
}

std::vector<int> CLaserModel::trueSegments(const TPose2D& T_w_r) const {
    std::vector<int> segments;
    for (const THit& hit : castAll(laserPose(T_w_r)))
        segments.push_back(hit.segment == kNothing ? -1 : static_cast<int>(hit.segment));
    return segments;
}

std::optional<double> CLaserModel::mixed(const TPose2D& T_w_l, double angle, double share) const {
    const TPoint2D origin(T_w_l.x, T_w_l.y);
    const double right = castOne(origin, angle - m_options.beamWidth / 2);
    const double left = castOne(origin, angle + m_options.beamWidth / 2);
    if (!(std::abs(right - left) > kMixStep) || std::isinf(right) || std::isinf(left))
        return std::nullopt;
    return right + share * (left - right);
}

mrpt::obs::CObservation2DRangeScan CLaserModel::scan(const TPose2D& T_w_r,
                                                     std::uint64_t index) const {
    const TPose2D T_w_l = laserPose(T_w_r);
    const auto hits = castAll(T_w_l);
    CRandom random(m_seed, "scan", index);
    mrpt::obs::CObservation2DRangeScan scan;
    scan.sensorLabel = "LASER";
    scan.sensorPose = mrpt::poses::CPose3D(m_options.x, 0, m_options.z, 0, 0, 0);
    scan.aperture = static_cast<float>(m_options.apertureAngle());
    scan.rightToLeft = true;
    scan.maxRange = static_cast<float>(m_options.maxRange());
    scan.beamAperture = static_cast<float>(m_options.beamWidth);
    const double stated = m_options.statedNoise > 0 ? m_options.statedNoise : m_options.noise;
    // noise of the range and of its rounding; the run's offset is not noise
    scan.stdError = static_cast<float>(std::hypot(stated, m_options.quantum() / std::sqrt(12.0)));
    scan.resizeScan(hits.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
        double range = hits[i].range;
        const double noise = random.normal(m_options.noise), share = random.unit();
        const bool edge = (i > 0 && hits[i - 1].segment != hits[i].segment) ||
                          (i + 1 < hits.size() && hits[i + 1].segment != hits[i].segment);
        if (edge) {
            const double angle = T_w_l.phi - m_options.apertureAngle() / 2 +
                                 static_cast<double>(i) * m_options.resolutionAngle();
            range = mixed(T_w_l, angle, share).value_or(range);
        }
        range = std::round((range + m_offset + noise) / m_options.quantum()) * m_options.quantum();
        const bool valid = range > 0 && range <= m_options.maxRange();
        scan.setScanRange(i, static_cast<float>(valid ? range : 0));
        scan.setScanRangeValidity(i, valid);
    }
    return scan;
}

}  // namespace salma::simulator
