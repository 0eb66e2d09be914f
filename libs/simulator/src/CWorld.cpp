// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/CWorld.h>

#include <Eigen/Geometry>
#include <cmath>

#include "CWorldBuilder.h"

namespace salma::simulator {

CWorld::CWorld(const TWorld& description) { CWorldBuilder(description, *this).build(); }

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
