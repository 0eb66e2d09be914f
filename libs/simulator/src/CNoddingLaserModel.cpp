// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/CNoddingLaserModel.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "seeds.h"

namespace salma::simulator {

using Eigen::Vector3d;
using mrpt::obs::CObservation2DRangeScan;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMixStep = 0.05;  // smaller steps inside a beam are no edge [m]

}  // namespace

CNoddingLaserModel::CNoddingLaserModel(const TLaserOptions& options,
                                       const TNoddingOptions& nodding,
                                       const CWorld& world,
                                       std::uint32_t seed)
    : m_options(options),
      m_nodding(nodding),
      m_world(world),
      m_seed(seed),
      m_offset(CRandom(seed, "laser offset", 0).uniform(-options.maxOffset, options.maxOffset)) {
    m_options.validate();
    if (nodding.scans < 2 || !(nodding.lowest < nodding.highest) ||
        !(std::abs(nodding.lowest) < M_PI / 2 && std::abs(nodding.highest) < M_PI / 2))
        throw std::invalid_argument("a nodding laser needs two scans and elevations in order");
}

CNoddingLaserModel::THit CNoddingLaserModel::cast(const Vector3d& from,
                                                  const Vector3d& direction) const {
    THit nearest{kInfinity, -1};
    const auto& faces = m_world.faces();
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const TFace& f = faces[i];
        const Vector3d normal = f.normal();
        const double towards = normal.dot(direction);
        if (std::abs(towards) < 1e-12) continue;
        const double range = normal.dot(f.origin - from) / towards;
        if (!(range > 0 && range < nearest.range)) continue;
        const Vector3d at = from + range * direction - f.origin;
        const double u = at.dot(f.right), v = at.dot(f.up);
        constexpr double slack = 1e-9;  // no gap where two faces meet
        if (u >= f.u0 - slack && u <= f.u1 + slack && v >= f.v0 - slack && v <= f.v1 + slack)
            nearest = {range, static_cast<int>(i)};
    }
    return nearest;
}

std::vector<CObservation2DRangeScan> CNoddingLaserModel::sweep(const mrpt::math::TPose2D& T_w_r,
                                                               std::uint64_t index) const {
    CRandom random(m_seed, "nodding noise", index);
    std::vector<CObservation2DRangeScan> scans;
    for (int k = 0; k < m_nodding.scans; ++k) {
        const double elevation =
            m_nodding.lowest + (m_nodding.highest - m_nodding.lowest) * k / (m_nodding.scans - 1);
        scans.push_back(scan(T_w_r, elevation, elevation, random));
    }
    return scans;
}

CObservation2DRangeScan CNoddingLaserModel::scan(const mrpt::math::TPose2D& T_w_r,
                                                 double first,
                                                 double last,
                                                 std::uint64_t index) const {
    CRandom random(m_seed, "nodding scan", index);
    return scan(T_w_r, first, last, random);
}

CObservation2DRangeScan CNoddingLaserModel::scan(const mrpt::math::TPose2D& T_w_r,
                                                 double first,
                                                 double last,
                                                 CRandom& random) const {
    const double step = m_options.resolutionAngle(), half = m_options.apertureAngle() / 2;
    const Eigen::AngleAxisd heading(T_w_r.phi, Vector3d::UnitZ());
    const Vector3d from =
        Vector3d(T_w_r.x, T_w_r.y, 0) + heading * Vector3d(m_options.x, 0, m_options.z);
    const auto along = [&](double bearing, double elevation) {
        const auto tilt = heading * Eigen::AngleAxisd(-elevation, Vector3d::UnitY());
        return Vector3d(tilt * Vector3d(std::cos(bearing), std::sin(bearing), 0));
    };
    CObservation2DRangeScan scan;
    scan.sensorLabel = "NODDING";
    scan.sensorPose = mrpt::poses::CPose3D(m_options.x, 0, m_options.z, 0, -(first + last) / 2, 0);
    scan.aperture = static_cast<float>(2 * half);
    scan.maxRange = static_cast<float>(m_options.maxRange());
    scan.beamAperture = static_cast<float>(m_options.beamWidth);
    scan.stdError =
        static_cast<float>(std::hypot(m_options.noise, m_options.quantum() / std::sqrt(12.0)));
    scan.resizeScan(m_options.beams());
    THit before{kInfinity, -1};
    for (std::size_t i = 0; i < m_options.beams(); ++i) {
        const double bearing = static_cast<double>(i) * step - half;
        const double elevation = first + (last - first) * (bearing + half) / (2 * half);
        const THit hit = cast(from, along(bearing, elevation));
        const double noise = random.normal(m_options.noise), share = random.unit();
        double range = hit.range;
        if (i > 0 && before.face != hit.face) {
            const double side = m_options.beamWidth / 2;
            const double right = cast(from, along(bearing - side, elevation)).range;
            const double left = cast(from, along(bearing + side, elevation)).range;
            if (std::abs(right - left) > kMixStep && std::isfinite(right + left))
                range = right + share * (left - right);
        }
        before = hit;
        range = std::round((range + m_offset + noise) / m_options.quantum()) * m_options.quantum();
        const bool valid = range > 0 && range <= m_options.maxRange();
        scan.setScanRange(i, static_cast<float>(valid ? range : 0));
        scan.setScanRangeValidity(i, valid);
    }
    return scan;
}

}  // namespace salma::simulator
