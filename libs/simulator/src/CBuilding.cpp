// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/simulator/CBuilding.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "CBuildingBuilder.h"

namespace salma::simulator {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr double kStep = 0.2;               // of a wandering robot [m]
constexpr double kTurn = M_PI / 12;         // [rad]
constexpr double kSway = 0.1;               // sigma of its way off the axis [m]
constexpr double kHeadingSway = M_PI / 45;  // sigma of its heading [rad]
constexpr double kKeep = 0.9;               // how much of both stays from step to step

void check(const TSpan& span, double least, const std::string& name) {
    if (!(span.min >= least && span.max >= span.min && std::isfinite(span.max)))
        throw std::invalid_argument("building: " + name + " is no span of at least " +
                                    std::to_string(least));
}

/// A walk that is being made.
struct TWalk {
    CRandom random;
    std::size_t steps;
    std::vector<TPose2D> poses;
    double off{0}, lean{0};  //!< Way off the axis and off its direction.

    bool done() const { return poses.size() >= steps; }
    void sway() {
        const double fresh = std::sqrt(1 - kKeep * kKeep);
        off = kKeep * off + random.normal(kSway * fresh);
        lean = kKeep * lean + random.normal(kHeadingSway * fresh);
    }
    void add(const TPoint2D& at, double direction) {
        if (done()) return;
        poses.emplace_back(at.x - off * std::sin(direction), at.y + off * std::cos(direction),
                           mrpt::math::wrapToPi(direction + lean));
    }
    void turn(const TPoint2D& at, double from, double to) {
        const double by = mrpt::math::wrapToPi(to - from);
        const double count = std::ceil(std::abs(by) / kTurn - 1e-9);
        // the sway is over when the robot has turned: it then means another direction
        const double firstOff = off;
        for (double k = 1; k < count; ++k) {
            off = firstOff * (1 - k / count);
            poses.emplace_back(at.x - off * std::sin(from), at.y + off * std::cos(from),
                               mrpt::math::wrapToPi(from + by * k / count));
        }
        if (count > 0) off = 0;
    }
};

}  // namespace

void TBuildingOptions::validate() const {
    check(corridorWidth, 1.2, "corridor width");
    check(corridorLength, 4, "corridor length");
    check(roomSize, 3.5, "room size");
    check(doorWidth, 0.6, "door width");
    if (!(corridors >= 1 && clutterPerRoom >= 0))
        throw std::invalid_argument("building: negative count");
    if (!(openShare >= 0 && openShare <= 1 && clutterPerMetre >= 0 && clutterPerMetre <= 1))
        throw std::invalid_argument("building: a probability is not in [0, 1]");
}

CBuilding::CBuilding(const TBuildingOptions& options, std::uint32_t seed) {
    options.validate();
    CBuildingBuilder(options, seed, *this).build();
}

double CBuilding::clearance(const TPoint2D& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const TSegment& s : m_segments) {
        const TPoint2D e = s.to - s.from;
        const double length2 = e.x * e.x + e.y * e.y;
        double t = length2 > 0 ? ((p.x - s.from.x) * e.x + (p.y - s.from.y) * e.y) / length2 : 0;
        t = std::clamp(t, 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(p.x - s.from.x - t * e.x, p.y - s.from.y - t * e.y));
    }
    return nearest;
}

bool CBuilding::inCorridor(const TPoint2D& p) const {
    return std::any_of(m_corridors.begin(), m_corridors.end(),
                       [&](const TCorridor& c) { return c.area.contains(p.x, p.y); });
}

std::vector<TPose2D> wander(const CBuilding& building, std::uint32_t seed, std::size_t steps) {
    const auto& stations = building.stations();
    TWalk walk{CRandom(seed, "wander", 0), steps, {}};
    std::size_t at = walk.random.bits() % stations.size(), before = stations.size();
    double heading = 0;
    while (!walk.done() && !stations[at].next.empty()) {
        std::vector<std::size_t> choices;
        for (const std::size_t next : stations[at].next)
            if (next != before) choices.push_back(next);
        const std::size_t next =
            choices.empty() ? before : choices[walk.random.bits() % choices.size()];
        const TPoint2D way = stations[next].at - stations[at].at;
        const double direction = std::atan2(way.y, way.x), length = way.norm();
        if (before == stations.size()) heading = direction;
        walk.turn(stations[at].at, heading, direction);
        for (double s = 0; s < length; s += kStep) {
            walk.sway();
            walk.add(stations[at].at + way * (s / length), direction);
        }
        heading = direction;
        before = at;
        at = next;
    }
    walk.poses.resize(std::min(walk.poses.size(), steps));
    return walk.poses;
}

}  // namespace salma::simulator
