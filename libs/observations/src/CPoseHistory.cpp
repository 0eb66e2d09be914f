// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/observations/CPoseHistory.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

#include "interpolation.h"

using mrpt::poses::CPose2D;

namespace salma::observations {

void CPoseHistory::add(double time, const CPose2D& pose) {
    const double last = m_times.empty() ? -std::numeric_limits<double>::infinity() : m_times.back();
    if (!(time >= last))
        throw std::invalid_argument("odometry at " + std::to_string(time) + " s comes after " +
                                    std::to_string(last) + " s");
    if (!m_times.empty() && time == m_times.back()) {
        m_poses.back() = pose;
        return;
    }
    m_times.push_back(time);
    m_poses.push_back(pose);
}

std::optional<CPose2D> CPoseHistory::at(double time, double maxSkew) const {
    const auto place = bracket(
        m_times.size(), [this](std::size_t i) { return m_times[i]; }, time, maxSkew);
    if (!place) return std::nullopt;
    const CPose2D& a = m_poses[place->before];
    const CPose2D& b = m_poses[place->after];
    const double turn = mrpt::math::wrapToPi(b.phi() - a.phi());
    return CPose2D(a.x() + place->part * (b.x() - a.x()), a.y() + place->part * (b.y() - a.y()),
                   mrpt::math::wrapToPi(a.phi() + place->part * turn));
}

void CPoseHistory::forgetBefore(double time) {
    const auto later = std::upper_bound(m_times.begin(), m_times.end(), time);
    if (later == m_times.begin()) return;
    const auto count = std::prev(later) - m_times.begin();
    m_times.erase(m_times.begin(), m_times.begin() + count);
    m_poses.erase(m_poses.begin(), m_poses.begin() + count);
}

}  // namespace salma::observations
