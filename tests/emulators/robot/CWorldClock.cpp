// SPDX-License-Identifier: BSD-3-Clause
#include "CWorldClock.h"

#include <algorithm>

namespace salma::test {

void CWorldClock::looked(std::size_t index, double now) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (index < m_next || index >= m_times.size()) return;
    m_next = index + 1;
    m_since = now;
}

double CWorldClock::at(double now) const {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_next == 0) return m_times.front();
    const double last = m_next < m_times.size() ? m_times[m_next] : m_times.back();
    return std::min(m_times[m_next - 1] + std::max(0.0, now - m_since), last);
}

}  // namespace salma::test
