// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/bits_math.h>
#include <salma/drivers/CNoddingSweep.h>

#include <cmath>
#include <utility>

namespace salma::drivers {
namespace {

constexpr double historyLength = 10;  // seconds
constexpr double turnedRound = mrpt::DEG2RAD(1.0);

}  // namespace

void CElevationHistory::add(double time, double elevation) {
    if (!m_elevations.empty() && time <= m_elevations.rbegin()->first) m_elevations.clear();
    m_elevations[time] = elevation;
    m_elevations.erase(m_elevations.begin(), m_elevations.lower_bound(time - historyLength));
}

std::optional<double> CElevationHistory::end() const {
    if (m_elevations.empty()) return std::nullopt;
    return m_elevations.rbegin()->first;
}

std::optional<double> CElevationHistory::at(double time, double maxGap) const {
    const auto after = m_elevations.lower_bound(time);
    if (after == m_elevations.end()) return std::nullopt;
    if (after->first == time) return after->second;
    if (after == m_elevations.begin()) return std::nullopt;
    const auto before = std::prev(after);
    const double gap = after->first - before->first;
    if (!(gap <= maxGap)) return std::nullopt;
    return before->second + (after->second - before->second) * (time - before->first) / gap;
}

void CNoddingSweep::clear() {
    m_scans.clear();
    m_direction = 0;
    m_extreme = 0;
}

std::vector<TPlacedScan> CNoddingSweep::add(TPlacedScan scan) {
    m_scans.push_back(std::move(scan));
    const double now = m_scans.back().elevation;
    if (m_direction == 0) {
        const double moved = now - m_scans.front().elevation;
        if (std::abs(moved) > turnedRound) m_direction = moved > 0 ? 1 : -1;
        m_extreme = m_scans.size() - 1;
    } else if (m_direction * (now - m_scans[m_extreme].elevation) >= 0) {
        m_extreme = m_scans.size() - 1;
    }
    const double back = m_direction * (m_scans[m_extreme].elevation - now);
    if (!(back > turnedRound) && m_scans.size() < maxScans) return {};
    const auto cut = m_scans.begin() + static_cast<std::ptrdiff_t>(m_extreme) + 1;
    std::vector<TPlacedScan> rest(std::make_move_iterator(cut),
                                  std::make_move_iterator(m_scans.end()));
    m_scans.erase(cut, m_scans.end());
    std::vector<TPlacedScan> sweep = std::exchange(m_scans, std::move(rest));
    m_direction = back > turnedRound ? -m_direction : 0;
    m_extreme = m_scans.empty() ? 0 : m_scans.size() - 1;
    return sweep;
}

}  // namespace salma::drivers
