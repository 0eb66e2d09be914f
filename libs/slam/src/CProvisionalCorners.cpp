// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/CProvisionalCorners.h>

#include <algorithm>

namespace salma::slam {

CProvisionalCorners::CProvisionalCorners(int sightings, double radius, int memory)
    : m_sightings(sightings), m_radius(radius), m_memory(memory) {}

void CProvisionalCorners::beginStep() {
    ++m_step;
    const auto forgotten = [this](const TCorner& c) { return m_step - c.lastStep > m_memory; };
    m_corners.erase(std::remove_if(m_corners.begin(), m_corners.end(), forgotten), m_corners.end());
}

bool CProvisionalCorners::confirms(const Eigen::Vector2d& position, bool convex) {
    if (m_sightings <= 1) return true;
    auto nearest = m_corners.end();
    double distance = m_radius;
    for (auto it = m_corners.begin(); it != m_corners.end(); ++it) {
        if (it->convex != convex || it->lastStep == m_step) continue;
        const double apart = (it->position - position).norm();
        if (!(apart <= distance)) continue;
        distance = apart;
        nearest = it;
    }
    if (nearest == m_corners.end()) {
        m_corners.push_back({position, convex, 1, m_step});
        return false;
    }
    nearest->position = position;
    nearest->lastStep = m_step;
    if (++nearest->sightings < m_sightings) return false;
    m_corners.erase(nearest);
    return true;
}

}  // namespace salma::slam
