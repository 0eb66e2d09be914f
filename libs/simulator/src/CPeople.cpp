// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/CPeople.h>

#include <algorithm>
#include <cmath>

#include "seeds.h"

namespace salma::simulator {
namespace {

constexpr double kFar = 12;      // farther people matter to no sensor [m]
constexpr double kRobot = 0.35;  // radius of the robot with some room [m]

}  // namespace

CPeople::CPeople(const TPeopleOptions& options, const CPath& path, std::uint32_t seed)
    : m_options(options), m_path(path) {
    m_options.validate();
    for (int i = 0; i < m_options.count; ++i) {
        CRandom random(seed, "person", static_cast<std::uint64_t>(i));
        TWalker walker{};
        walker.start = random.uniform(0, path.lapLength());
        walker.speed = m_options.speed * random.uniform(0.6, 1.4) * (random.unit() < 0.5 ? -1 : 1);
        walker.aside =
            m_options.aside * random.uniform(0.85, 1.15) * (random.unit() < 0.5 ? -1 : 1);
        walker.clothes = random.bits();
        m_walkers.push_back(walker);
    }
}

std::vector<TPerson> CPeople::around(double time) const {
    std::vector<TPerson> people;
    if (m_walkers.empty()) return people;
    const auto robot = m_path.pose(time);
    const int floor = m_path.floor(time);
    for (const auto& walker : m_walkers) {
        double along = std::fmod(walker.start + walker.speed * time, m_path.lapLength());
        if (along < 0) along += m_path.lapLength();
        if (m_path.floorAt(along) != floor) continue;
        const auto place = m_path.beside(along, walker.aside);
        const double distance = std::hypot(place.x - robot.x, place.y - robot.y);
        if (distance < kFar && distance > m_options.radius + kRobot)
            people.push_back({{place.x, place.y}, walker.clothes});
    }
    return people;
}

bool CPeople::hide(const std::vector<TPerson>& people,
                   const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b) const {
    return std::any_of(people.begin(), people.end(), [&](const TPerson& person) {
        const Eigen::Vector2d ray = (b - a).head<2>();
        const Eigen::Vector2d towards(person.place.x - a.x(), person.place.y - a.y());
        const double part = std::clamp(towards.dot(ray) / ray.squaredNorm(), 0.0, 1.0);
        return (towards - part * ray).norm() < m_options.radius &&
               a.z() + part * (b.z() - a.z()) < m_options.height;
    });
}

}  // namespace salma::simulator
