// SPDX-License-Identifier: BSD-3-Clause
#include "CPrints.h"

#include <cmath>

#include "planeMotion.h"

namespace salma::slam {
namespace {

constexpr double elsewhereFrom = 1;   // two landmarks nearer than this may be one seen twice [m]
constexpr double priorOfTwins = 0.1;  // odds that two posters of a building are prints of one
constexpr double leastOdds = 0.02;    // less is not looked at

}  // namespace

void CPrints::add(const TPoster& a, const TPoster& b, bool across, double logRatio) {
    const double odds = priorOfTwins * std::exp(logRatio);
    if (!(odds > leastOdds)) return;  // false for NaN
    m_others[a.index].push_back({b.place, across, odds});
    m_others[b.index].push_back({a.place, across, odds});
}

bool CPrints::repeats(const TPoster& poster, const Eigen::Vector3d& T) const {
    const auto others = m_others.find(poster.index);
    if (others == m_others.end()) return false;
    double single = 1;
    for (const TOther& other : others->second) {
        const Eigen::Vector2d place = other.across ? applied(T, other.place) : other.place;
        if ((place - poster.place).norm() > elsewhereFrom) single /= 1 + other.odds;
    }
    return single < 0.5;
}

}  // namespace salma::slam
