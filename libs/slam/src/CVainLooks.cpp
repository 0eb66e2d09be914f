// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/CVainLooks.h>

#include <algorithm>
#include <cmath>

namespace salma::slam {

namespace {

constexpr double leastProbability = 0.1;  // of detection: less says nothing
constexpr double anotherLook = 0.5;       // travel to it [m]
constexpr int sectors = 8;                // in which directions from a landmark are told apart

int sectorOf(const Eigen::Vector2d& fromLandmark) {
    const double turn = std::atan2(fromLandmark.y(), fromLandmark.x()) / (2 * M_PI) + 0.5;
    return std::clamp(static_cast<int>(turn * sectors), 0, sectors - 1);
}

}  // namespace

void CVainLooks::see(int id, const Eigen::Vector2d& back) {
    TLooks& looks = m_looks[id];
    looks.inVain = 0;
    looks.farthest = std::max(looks.farthest, back.norm());
    looks.from.insert(sectorOf(back));
}

double CVainLooks::miss(int id, const Eigen::Vector2d& back, double travel, double probability) {
    TLooks& looks = m_looks[id];
    if (back.norm() > looks.farthest || looks.from.count(sectorOf(back)) == 0 ||
        travel < looks.last + anotherLook || !(probability > leastProbability))
        return looks.inVain;
    looks.inVain -= std::log1p(-probability);
    looks.last = travel;
    return looks.inVain;
}

}  // namespace salma::slam
