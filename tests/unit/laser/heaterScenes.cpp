// SPDX-License-Identifier: BSD-3-Clause
#include "heaterScenes.h"

#include <salma/simulator/CLaserModel.h>
#include <salma/simulator/CNoddingLaserModel.h>

#include <cmath>
#include <random>
#include <string>

namespace salma::laser::test {
namespace {

constexpr double kNear = 0.04;                       // of a plane to where it should be [m]
constexpr double kBeyond = 0.4;                      // that a front may seem too long [m]
const double kAligned = std::cos(5 * M_PI / 180.0);  // of its normal

class CDice {
 public:
    explicit CDice(std::uint32_t seed) : m_engine(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(m_engine()) / 4294967296.0;
    }

 private:
    std::mt19937 m_engine;
};

void addWall(
    const std::string& name, double x0, double y0, double x1, double y1, simulator::TWorld& world) {
    simulator::TWall wall;
    wall.name = name;
    wall.from = {x0, y0};
    wall.to = {x1, y1};
    world.walls.push_back(wall);
}

void addDoors(
    const std::string& wall, double from, double to, CDice& dice, simulator::TWorld& world) {
    simulator::TDoor door;
    door.name = wall;
    door.wall = wall;
    for (double at = from; at < to; at += dice.uniform(2, 4)) door.at.push_back(at);
    if (!door.at.empty()) world.doors.push_back(door);
}

/// Does the plane pass through the middle of the heater's front, or `behind` it, and reach there?
bool liesOn(const TPlanePatch& plane, const THeaterScene& scene, double behind, double beside) {
    const Eigen::Vector2d normal = plane.normal.head<2>();
    const Eigen::Vector2d at = scene.front + behind * scene.intoWall;
    const double across = plane.across.head<2>().dot(at);
    return normal.dot(scene.intoWall) >= kAligned &&
           std::abs(normal.dot(at) - plane.distance) <= kNear && across >= plane.low.x() - beside &&
           across <= plane.high.x() + beside;
}

}  // namespace

THeaterScene heaterScene(const simulator::TLaserOptions& laserOptions, std::uint32_t seed) {
    CDice dice(seed);
    simulator::TWorld world;
    const double width = dice.uniform(1.6, 3), side = dice.uniform(0, 1) < 0.5 ? 1 : -1;
    addWall("north", -8, width / 2, 8, width / 2, world);
    addWall("east", 8, width / 2, 8, -width / 2, world);
    addWall("south", 8, -width / 2, -8, -width / 2, world);
    addWall("west", -8, -width / 2, -8, width / 2, world);
    THeaterScene scene;
    scene.length = dice.uniform(0.6, 1.6);
    scene.depth = dice.uniform(0.08, 0.2);
    const double x = dice.uniform(-2, 2);
    simulator::TBox heater;
    heater.name = "heater";
    heater.centre = {x, side * (width - scene.depth) / 2};
    heater.length = scene.length;
    heater.depth = scene.depth;
    heater.bottom = dice.uniform(0, 0.12);
    heater.top = dice.uniform(0.5, 0.9);
    world.boxes.push_back(heater);
    addDoors(side > 0 ? "south" : "north", dice.uniform(1, 2), 15, dice, world);
    const double place = side > 0 ? x + 8 : 8 - x;  // along the heater's own wall
    addDoors(side > 0 ? "north" : "south", place + 2, 15, dice, world);

    const double free = width - scene.depth - 0.8;
    const double away = 0.4 + dice.uniform(0, 1) * free;  // from the heater's front
    const double reach = std::sqrt(9 - away * away);
    const double robotX = x + dice.uniform(-0.8, 0.8) * std::min(reach, 2.5);
    const double robotY = side * (width / 2 - scene.depth - away);
    const double towards = std::atan2(side * away, x - robotX);
    const mrpt::math::TPose2D T_w_r(robotX, robotY, towards + dice.uniform(-0.87, 0.87));
    const simulator::CWorld built(world);
    scene.sweep = simulator::CNoddingLaserModel(laserOptions, {}, built, seed).sweep(T_w_r, 0);
    scene.level = simulator::CLaserModel(laserOptions, built, seed).scan(T_w_r, 0);
    const double c = std::cos(T_w_r.phi), s = std::sin(T_w_r.phi);
    const double dx = x - robotX, dy = side * away;
    scene.front = {c * dx + s * dy, -s * dx + c * dy};
    scene.intoWall = {s * side, c * side};
    return scene;
}

THeaterVerdict judge(const THeaterScene& scene, const TPlaneResult& result) {
    THeaterVerdict verdict;
    for (const TPlanePatch& plane : result.planes) {
        const bool front =
            liesOn(plane, scene, 0, kNear) && plane.size().x() <= scene.length + kBeyond;
        verdict.frontFound |= front;
        verdict.toldFromWall |= front && plane.kind == EPlaneKind::protrusion;
        verdict.wallFound |=
            liesOn(plane, scene, scene.depth, scene.length) && plane.kind == EPlaneKind::wall;
        verdict.otherProtrusion |= !front && plane.kind == EPlaneKind::protrusion;
    }
    for (const TLine& line : CLineExtractor().extract(scene.level).lines) {
        const Eigen::Vector2d normal(std::cos(line.alpha), std::sin(line.alpha));
        verdict.falseWall2D |= normal.dot(scene.intoWall) >= kAligned &&
                               std::abs(normal.dot(scene.front) - line.rho) <= kNear &&
                               line.length() >= 0.3;
    }
    return verdict;
}

}  // namespace salma::laser::test
