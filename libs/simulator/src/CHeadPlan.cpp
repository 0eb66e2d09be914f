// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/simulator/CHeadPlan.h>

#include <algorithm>
#include <cmath>

#include "seeds.h"

namespace salma::simulator {
namespace {

const double kMaxPan = mrpt::DEG2RAD(100.0);       // of the EVI-D30
const double kMaxIncidence = mrpt::DEG2RAD(70.0);  // flatter views of a poster are not worth it

}  // namespace

CHeadPlan::CHeadPlan(const THeadOptions& options,
                     const CPath& path,
                     const CWorld& world,
                     std::uint32_t seed)
    : CHeadPlan(
          options, path, [&world](double) -> const CWorld& { return world; }, seed) {}

CHeadPlan::CHeadPlan(const THeadOptions& options,
                     const CPath& path,
                     const WorldAt& world,
                     std::uint32_t seed)
    : m_options(options) {
    m_options.validate();
    const bool fixed = m_options.kind() == EHeadMode::fixed;
    CRandom random(seed, "head", 0);
    double pan = fixed ? m_options.fixedPan() : mrpt::DEG2RAD(m_options.stops.front());
    double time = 0;
    m_knots.push_back({time, pan});
    while (true) {
        const auto poster =
            m_options.kind() == EHeadMode::attend ? target(path, world, time, pan) : std::nullopt;
        const double next = fixed ? pan : poster.value_or(nextStop());
        const double arrival = time + std::abs(next - pan) / m_options.speed;
        const double jitter = std::clamp(random.normal(m_options.jitter), -0.04, 0.04);
        const double picture = arrival + m_options.settle + jitter;
        if (!(picture < path.duration())) break;
        m_pictureTimes.push_back(picture);
        const bool moves = std::abs(next - pan) > mrpt::DEG2RAD(5.0);
        time = arrival + (moves ? m_options.dwell : std::max(m_options.dwell, m_options.period));
        pan = next;
        m_knots.push_back({arrival, pan});
        m_knots.push_back({time, pan});
    }
}

double CHeadPlan::nextStop() {
    const std::size_t current = m_stop;
    if (m_options.stops.size() > 1) {
        if (m_stop + 1 == m_options.stops.size()) m_forth = false;
        if (m_stop == 0) m_forth = true;
        m_stop = m_forth ? m_stop + 1 : m_stop - 1;
    }
    return mrpt::DEG2RAD(m_options.stops[current]);
}

std::optional<double> CHeadPlan::target(const CPath& path,
                                        const WorldAt& world,
                                        double time,
                                        double pan) const {
    std::optional<double> found;
    double arrival = time;
    for (int i = 0; i < 3; ++i) {  // the robot drives on while the head turns
        found = nearestPoster(path, world(arrival), arrival + m_options.settle);
        if (!found) break;
        arrival = time + std::abs(*found - pan) / m_options.speed;
    }
    return found;
}

std::optional<double> CHeadPlan::nearestPoster(const CPath& path,
                                               const CWorld& world,
                                               double time) const {
    const auto robot = path.pose(time);
    const Eigen::Vector3d axis(robot.x + m_options.x * std::cos(robot.phi),
                               robot.y + m_options.x * std::sin(robot.phi), m_options.z);
    std::optional<double> best;
    double nearest = m_options.attendRange;
    for (const auto& landmark : world.landmarks()) {
        if (landmark.kind != ETruthKind::salient) continue;
        const Eigen::Vector2d ray = (landmark.centre - axis).head<2>();
        const double range = ray.norm();
        const double facing =
            -(ray.x() * std::cos(landmark.yaw) + ray.y() * std::sin(landmark.yaw));
        const double pan = mrpt::math::wrapToPi(std::atan2(ray.y(), ray.x()) - robot.phi);
        if (!(range < nearest && std::abs(pan) <= kMaxPan &&
              facing > range * std::cos(kMaxIncidence)))
            continue;
        if (!world.visible(axis, landmark.centre)) continue;
        nearest = range;
        best = pan;
    }
    return best;
}

double CHeadPlan::pan(double time) const {
    const auto next = std::upper_bound(m_knots.begin(), m_knots.end(), time,
                                       [](double t, const TKnot& k) { return t < k.time; });
    if (next == m_knots.begin()) return m_knots.front().pan;
    if (next == m_knots.end()) return m_knots.back().pan;
    const TKnot &a = *(next - 1), &b = *next;
    return a.pan + (b.pan - a.pan) * (time - a.time) / (b.time - a.time);
}

}  // namespace salma::simulator
