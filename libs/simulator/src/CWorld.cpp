// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/CWorld.h>

#include <Eigen/Geometry>
#include <cmath>

#include "CLandmarkRegister.h"
#include "CTextureStore.h"
#include "CWorldBuilder.h"

namespace salma::simulator {

CWorld::CWorld(const TWorld& description) {
    CTextureStore textures(description.file.parent_path());
    CLandmarkRegister landmarks(description);
    *this = CWorld(description, 1, 1, textures, landmarks);
}

CWorld::CWorld(const TWorld& description,
               int lap,
               int floor,
               CTextureStore& textures,
               CLandmarkRegister& landmarks) {
    CWorldBuilder({description, lap, floor}, textures, landmarks, *this).build();
}

void CWorld::addPerson(const mrpt::math::TPoint2D& place,
                       const TPeopleOptions& people,
                       std::uint64_t clothes) {
    constexpr int sides = 8;
    constexpr double waist = 0.55;  // of the height
    const auto colour = [](std::uint64_t bits) {
        const cv::Scalar bgr(20.0 + bits % 160, 20.0 + bits / 256 % 160, 20.0 + bits / 65536 % 160);
        return std::make_shared<CMipMap>(cv::Mat(1, 1, CV_8UC3, bgr), true);
    };
    TSurface surface;
    surface.texture = colour(clothes);
    const double width = 2 * people.radius * std::tan(M_PI / sides);
    surface.decals.push_back(
        {0, width, waist * people.height, people.height, colour(clothes >> 24)});
    m_surfaces.push_back(surface);
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * M_PI * i / sides;
        const Eigen::Vector3d outwards(std::cos(angle), std::sin(angle), 0);
        const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(outwards);
        TFace face{
            Eigen::Vector3d(place.x, place.y, 0) + people.radius * outwards - width / 2 * right,
            right,
            Eigen::Vector3d::UnitZ(),
            0,
            width,
            0,
            people.height};
        face.surface = m_surfaces.size() - 1;
        face.brightness = 0.8 + 0.15 * std::cos(angle);
        m_faces.push_back(face);
    }
}

std::vector<TSegment> CWorld::segmentsAt(double height) const {
    std::vector<TSegment> segments;
    for (const auto& f : m_faces) {
        if (!f.upright || !(f.v0 <= height && height <= f.v1) || !(f.u1 - f.u0 > 1e-9)) continue;
        const Eigen::Vector3d a = f.at(f.u0, 0), b = f.at(f.u1, 0);
        segments.push_back({{a.x(), a.y()}, {b.x(), b.y()}});
    }
    return segments;
}

double CWorld::distanceTo(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& f : m_faces) {
        const Eigen::Vector3d normal = f.normal();
        const double towards = normal.dot(direction);
        if (std::abs(towards) < 1e-12) continue;
        const double distance = normal.dot(f.origin - from) / towards;
        if (!(distance > 0 && distance < nearest)) continue;
        const Eigen::Vector3d hit = from + distance * direction - f.origin;
        const double u = hit.dot(f.right), v = hit.dot(f.up);
        if (u >= f.u0 && u <= f.u1 && v >= f.v0 && v <= f.v1) nearest = distance;
    }
    return nearest;
}

bool CWorld::visible(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    constexpr double endMargin = 1e-4;  // the points may lie on faces [m]
    const Eigen::Vector3d ray = b - a;
    const double length = ray.norm();
    for (const auto& f : m_faces) {
        const Eigen::Vector3d normal = f.normal();
        const double towards = normal.dot(ray);
        if (std::abs(towards) < 1e-12) continue;
        const double part = normal.dot(f.origin - a) / towards;
        if (!(part * length > endMargin && (1 - part) * length > endMargin)) continue;
        const Eigen::Vector3d hit = a + part * ray - f.origin;
        const double u = hit.dot(f.right), v = hit.dot(f.up);
        if (u >= f.u0 && u <= f.u1 && v >= f.v0 && v <= f.v1) return false;
    }
    return true;
}

}  // namespace salma::simulator
