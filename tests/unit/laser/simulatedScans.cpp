// SPDX-License-Identifier: BSD-3-Clause
#include "simulatedScans.h"

#include <salma/simulator/CWorld.h>

#include <cmath>
#include <random>
#include <string>

namespace salma::laser::test {
namespace {

using mrpt::math::TPoint2D;
using simulator::TWorld;

constexpr double kClearance = 0.4;  // the robot's distance to walls [m]

/// Uniform numbers that are the same on every platform.
class CDice {
 public:
    explicit CDice(std::uint32_t seed) : m_engine(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(m_engine()) / 4294967296.0;
    }

 private:
    std::mt19937 m_engine;
};

/// Walls around a polygon that is walked clockwise, so that each is faced from inside.
void addWalls(const std::vector<TPoint2D>& corners, TWorld& world) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const TPoint2D& a = corners[i];
        const TPoint2D& b = corners[(i + 1) % corners.size()];
        simulator::TWall wall;
        wall.name = "w" + std::to_string(i);
        wall.from = {a.x, a.y};
        wall.to = {b.x, b.y};
        world.walls.push_back(wall);
    }
}

void addBox(const TPoint2D& centre, double yaw, double length, double depth, TWorld& world) {
    simulator::TBox box;
    box.name = "b" + std::to_string(world.boxes.size());
    box.centre = {centre.x, centre.y};
    box.yaw = yaw;
    box.length = length;
    box.depth = depth;
    world.boxes.push_back(box);
}

void addDoors(std::size_t wall, CDice& dice, TWorld& world) {
    simulator::TDoor door;
    door.name = "d" + std::to_string(wall);
    door.wall = world.walls[wall].name;
    door.depth = dice.uniform(0.08, 0.2);
    const double length = world.walls[wall].length();
    for (double at = dice.uniform(0.7, 2); at + 0.6 < length; at += dice.uniform(1.8, 4))
        door.at.push_back(at);
    if (!door.at.empty()) world.doors.push_back(door);
}

TWorld room(CDice& dice) {
    TWorld world;
    const double x = dice.uniform(2, 4.5), y = dice.uniform(2, 4.5);
    addWalls({{-x, -y}, {-x, y}, {x, y}, {x, -y}}, world);
    addDoors(static_cast<std::size_t>(dice.uniform(0, 4)), dice, world);
    for (int i = 0; i < 4; ++i)
        addBox({dice.uniform(-x, x), dice.uniform(-y, y)}, dice.uniform(-M_PI, M_PI),
               dice.uniform(0.3, 1.6), dice.uniform(0.25, 0.7), world);
    return world;
}

/// Along x from -8, with a bend to the left.
TWorld corridor(CDice& dice) {
    TWorld world;
    const double w = dice.uniform(1.6, 3.2), x = dice.uniform(4, 9), y = dice.uniform(4, 9);
    addWalls({{-8, 0}, {-8, w}, {x - w, w}, {x - w, y}, {x, y}, {x, 0}}, world);
    for (const std::size_t wall : {1, 2, 4, 5}) addDoors(wall, dice, world);
    addBox({dice.uniform(-7, x - 2), 0.08}, 0, dice.uniform(0.6, 1.6), 0.16, world);
    return world;
}

double distance(const simulator::TSegment& s, const TPoint2D& p) {
    const TPoint2D d = s.to - s.from;
    const double t = ((p.x - s.from.x) * d.x + (p.y - s.from.y) * d.y) / d.sqrNorm();
    return (s.from + d * std::clamp(t, 0.0, 1.0) - p).norm();
}

/// Inside of an odd number of outlines: inside of the walls and of no box.
bool isFree(const TWorld& description,
            const std::vector<simulator::TSegment>& segments,
            const TPoint2D& p) {
    bool inside = false;
    for (const auto& wall : description.walls) {
        const TPoint2D a = wall.left(), b = wall.right();
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    for (const auto& box : description.boxes)
        inside = inside && std::hypot(p.x - box.centre[0], p.y - box.centre[1]) >
                               0.5 * std::hypot(box.length, box.depth);
    for (const auto& s : segments) inside = inside && distance(s, p) >= kClearance;
    return inside;
}

}  // namespace

std::vector<TTrueScan> simulatedScans(const simulator::TLaserOptions& options,
                                      std::uint32_t seed,
                                      std::size_t count) {
    CDice dice(seed);
    const TWorld description = seed % 2 == 0 ? room(dice) : corridor(dice);
    const simulator::CWorld world(description);
    const simulator::CLaserModel laser(options, world, seed);
    std::vector<TTrueScan> scans;
    while (scans.size() < count) {
        const mrpt::math::TPose2D T_w_r(dice.uniform(-9, 9), dice.uniform(-9, 9),
                                        dice.uniform(-M_PI, M_PI));
        if (!isFree(description, laser.segments(), {T_w_r.x, T_w_r.y})) continue;
        TTrueScan scan{laser.scan(T_w_r, scans.size()), {}, laser.trueSegments(T_w_r)};
        const auto T_r_w = mrpt::poses::CPose2D() - mrpt::poses::CPose2D(T_w_r);
        for (const auto& s : laser.segments()) {
            TTrueWall wall;
            T_r_w.composePoint(s.from.x, s.from.y, wall.a.x, wall.a.y);
            T_r_w.composePoint(s.to.x, s.to.y, wall.b.x, wall.b.y);
            scan.walls.push_back(wall);
        }
        for (std::size_t i = 0; i < scan.hits.size(); ++i)
            if (!scan.scan.getScanRangeValidity(i)) scan.hits[i] = -1;
        scans.push_back(std::move(scan));
    }
    return scans;
}

}  // namespace salma::laser::test
