// SPDX-License-Identifier: BSD-3-Clause
#include "CWorldBuilder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace salma::simulator {

using Eigen::Vector3d;
using mrpt::math::TPoint2D;

namespace {

constexpr double kFrame = 0.07;     // width of the frame around a door [m]
constexpr double kSkirting = 0.09;  // height of the strip along the floor [m]

/// Walls differ a little, as if most light came from one side.
double lightOn(const Vector3d& normal) {
    const Vector3d light = Vector3d(std::cos(0.6), std::sin(0.6), 0);
    return 0.88 + 0.09 * normal.dot(light);
}

Vector3d onFloor(const TPoint2D& p) { return {p.x, p.y, 0}; }

std::shared_ptr<const CMipMap> plainColour(const cv::Scalar& colour) {
    return std::make_shared<CMipMap>(cv::Mat(1, 1, CV_8UC3, colour), false);
}

}  // namespace

CWorldBuilder::CWorldBuilder(const TScene& scene,
                             CTextureStore& textures,
                             CLandmarkRegister& landmarks,
                             CWorld& world)
    : m_description(scene.description),
      m_lap(scene.lap),
      m_floor(scene.floor),
      m_textures(textures),
      m_register(landmarks),
      m_world(world) {}

void CWorldBuilder::build() {
    addFloorAndCeiling();
    for (const auto& wall : m_description.walls)
        if (wall.floor == m_floor) addWall(wall);
    for (const auto& box : m_description.boxes)
        if (box.floor == m_floor) addBox(box);
    for (const auto& lamp : m_description.lamps)
        if (lamp.floor == m_floor)
            m_world.m_lights.push_back({{lamp.position[0], lamp.position[1], lamp.position[2]},
                                        lamp.brightness,
                                        lamp.width});
    m_segments = m_world.segmentsAt(m_description.laser.z);
    addCorners();
}

std::size_t CWorldBuilder::addSurface(const std::string& name, double textureWidth) {
    const auto& tile = m_textures.get(name, true);
    TSurface surface;
    surface.texture = tile.map;
    surface.textureWidth = tile.width > 0 ? tile.width : textureWidth;
    m_world.m_surfaces.push_back(surface);
    return m_world.m_surfaces.size() - 1;
}

TFace& CWorldBuilder::addUpright(const Vector3d& left, const Vector3d& right, double length) {
    TFace face{left, right, Vector3d::UnitZ(), 0, length, 0, m_description.room.ceilingHeight};
    face.brightness = lightOn(face.normal());
    m_world.m_faces.push_back(face);
    return m_world.m_faces.back();
}

void CWorldBuilder::addFloorAndCeiling() {
    Eigen::AlignedBox2d extent;
    for (const auto& w : m_description.walls) {
        extent.extend(Eigen::Vector2d(w.left().x, w.left().y));
        extent.extend(Eigen::Vector2d(w.right().x, w.right().y));
    }
    const Eigen::Vector2d low = extent.min().array() - 1, size = extent.sizes().array() + 2;
    TFace floor{
        {low.x(), low.y(), 0}, Vector3d::UnitX(), Vector3d::UnitY(), 0, size.x(), 0, size.y()};
    floor.upright = false;
    floor.brightness = 0.8;
    floor.surface = addSurface(m_description.room.floor, 1);
    TFace ceiling = floor;
    ceiling.origin = {low.x(), low.y() + size.y(), m_description.room.ceilingHeight};
    ceiling.up = -Vector3d::UnitY();
    ceiling.brightness = 0.97;
    ceiling.surface = addSurface(m_description.room.ceiling, 1);
    m_world.m_faces.insert(m_world.m_faces.end(), {floor, ceiling});
}

void CWorldBuilder::addWall(const TWall& wall) {
    const Vector3d left = onFloor(wall.left());
    const Vector3d right = (onFloor(wall.right()) - left) / wall.length();
    const std::size_t surface = addSurface(wall.texture, wall.textureWidth);
    m_world.m_surfaces[surface].decals.push_back(
        {0, wall.length(), 0, kSkirting, plainColour({62, 74, 82})});
    std::vector<std::pair<double, double>> openings;
    for (const auto& door : m_description.doors)
        for (const double at : door.at) {
            if (door.wall != wall.name) continue;
            addDoor(wall, door, at);
            const double u0 = at - door.width / 2, u1 = at + door.width / 2;
            openings.emplace_back(u0, u1);
            TFace& lintel = addUpright(left, right, wall.length());
            lintel.u0 = u0;
            lintel.u1 = u1;
            lintel.v0 = door.height;
            lintel.surface = surface;
            const auto wood = m_textures.get("wood", false).map;
            auto& decals = m_world.m_surfaces[surface].decals;
            decals.push_back({u0 - kFrame, u0, 0, door.height + kFrame, wood});
            decals.push_back({u1, u1 + kFrame, 0, door.height + kFrame, wood});
            decals.push_back({u0, u1, door.height, door.height + kFrame, wood});
        }
    std::sort(openings.begin(), openings.end());
    openings.emplace_back(wall.length(), wall.length());
    double start = 0;
    for (const auto& [u0, u1] : openings) {
        TFace& piece = addUpright(left, right, wall.length());
        piece.u0 = start;
        piece.u1 = u0;
        piece.surface = surface;
        start = u1;
    }
    for (const auto& poster : m_description.posters)
        if (poster.wall == wall.name) addPoster(poster, m_world.m_surfaces[surface]);
}

void CWorldBuilder::addDoor(const TWall& wall, const TDoor& door, double at) {
    const Vector3d right = (onFloor(wall.right()) - onFloor(wall.left())) / wall.length();
    const Vector3d normal = right.cross(Vector3d::UnitZ());
    const Vector3d frontLeft = onFloor(wall.left()) + (at - door.width / 2) * right;
    const Vector3d frontRight = frontLeft + door.width * right;
    const bool open = door.isOpen(m_lap);
    const double depth = open ? door.closet : door.depth;
    const Vector3d inwards = -depth * normal;
    const std::size_t wood = addSurface("wood", 1);
    const std::size_t leaf = addSurface("wood", 1);
    m_world.m_surfaces[leaf].decals.push_back(
        {0, door.width, 0, door.height, m_textures.get(door.texture, false).map});

    const std::size_t first = m_world.m_faces.size();
    addUpright(frontLeft + inwards, right, door.width).surface = open ? wood : leaf;
    addUpright(frontLeft, -normal, depth).surface = wood;
    addUpright(frontRight + inwards, normal, depth).surface = wood;
    if (open) {  // the leaf stands inwards at its left edge, where the hinges are
        constexpr double gap = 0.05;
        const double reach = std::min(door.width, depth - door.depth - gap);
        addUpright(frontLeft - door.depth * normal + gap * right, -normal, reach).surface = leaf;
    }
    for (std::size_t i = first; i < m_world.m_faces.size(); ++i) {
        m_world.m_faces[i].v1 = door.height;
        m_world.m_faces[i].brightness *= 0.93;  // a recess gets less light
    }
    TFace soffit{
        frontLeft + inwards + Vector3d(0, 0, door.height), right, normal, 0, door.width, 0, depth};
    soffit.surface = wood;
    soffit.brightness = 0.6;
    soffit.upright = false;
    m_world.m_faces.push_back(soffit);
}

void CWorldBuilder::addBox(const TBox& box) {
    const Vector3d along(std::cos(box.yaw), std::sin(box.yaw), 0);
    const Vector3d across = Vector3d::UnitZ().cross(along);
    const Vector3d centre(box.centre[0], box.centre[1], 0);
    const Vector3d a = along * box.length / 2, b = across * box.depth / 2;
    const std::size_t surface = addSurface(box.texture, box.length);
    const std::size_t first = m_world.m_faces.size();
    // each side as one faces it from outside
    addUpright(centre - a - b, along, box.length);
    addUpright(centre + a - b, across, box.depth);
    addUpright(centre + a + b, -along, box.length);
    addUpright(centre - a + b, -across, box.depth);
    for (std::size_t i = first; i < m_world.m_faces.size(); ++i) {
        m_world.m_faces[i].v0 = box.bottom;
        m_world.m_faces[i].v1 = box.top;
        m_world.m_faces[i].surface = surface;
    }
    for (const double height : {box.bottom, box.top}) {
        TFace lid{
            centre - a - b + Vector3d(0, 0, height), along, across, 0, box.length, 0, box.depth};
        lid.surface = surface;
        lid.upright = false;
        lid.brightness = height == box.top ? 1.0 : 0.5;
        m_world.m_faces.push_back(lid);
    }
}

void CWorldBuilder::addPoster(const TPoster& poster, TSurface& surface) {
    const bool moved = poster.isMoved(m_lap);
    const double u = moved ? poster.movedAt : poster.at, v = poster.centreHeight;
    const double w = poster.width / 2, h = poster.height / 2, b = poster.border;
    if (b > 0) surface.decals.push_back({u - w, u + w, v - h, v + h, plainColour({28, 30, 34})});
    surface.decals.push_back({u - w + b, u + w - b, v - h + b, v + h - b,
                              m_textures.get(poster.texture, false).map,
                              static_cast<float>(poster.gloss)});
    const TWall& wall = m_description.wall(poster.wall);
    const Vector3d left = onFloor(wall.left());
    const Vector3d right = (onFloor(wall.right()) - left) / wall.length();
    const Vector3d normal = right.cross(Vector3d::UnitZ());
    TTrueLandmark truth;
    truth.kind = ETruthKind::salient;
    truth.centre = left + u * right + Vector3d(0, 0, v);
    truth.yaw = std::atan2(normal.y(), normal.x());
    truth.width = poster.width;
    truth.height = poster.height;
    truth.texture = std::filesystem::path(poster.texture).filename().string();
    m_register.addPoster(poster.name, moved, truth);
    m_world.m_landmarks.push_back(truth);
}

bool CWorldBuilder::isCorner(const TPoint2D& point, std::size_t segment) const {
    const auto direction = [](const TSegment& s) {
        return (s.to - s.from) * (1 / (s.to - s.from).norm());
    };
    const TPoint2D d = direction(m_segments[segment]);
    for (std::size_t i = 0; i < m_segments.size(); ++i) {
        const TSegment& s = m_segments[i];
        const TPoint2D e = direction(s), offset = point - s.from;
        const double along = offset.x * e.x + offset.y * e.y;
        const double aside = offset.x * e.y - offset.y * e.x;
        if (i != segment && std::abs(aside) < 1e-6 && along > -1e-6 &&
            along < (s.to - s.from).norm() + 1e-6 && std::abs(d.x * e.y - d.y * e.x) > 0.05)
            return true;
    }
    return false;
}

void CWorldBuilder::addCorners() {
    std::vector<TPoint2D> corners;
    for (std::size_t i = 0; i < m_segments.size(); ++i)
        for (const TPoint2D& end : {m_segments[i].from, m_segments[i].to}) {
            const bool known = std::any_of(corners.begin(), corners.end(), [&](const TPoint2D& c) {
                return (c - end).norm() < 1e-5;
            });
            if (!known && isCorner(end, i)) corners.push_back(end);
        }
    for (const auto& c : corners) {
        TTrueLandmark truth;
        truth.centre = {c.x, c.y, m_description.laser.z};
        m_register.addCorner(m_floor, truth);
        m_world.m_landmarks.push_back(truth);
    }
}

}  // namespace salma::simulator
