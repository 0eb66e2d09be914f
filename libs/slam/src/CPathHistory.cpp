// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/CPathHistory.h>

#include <algorithm>
#include <utility>

namespace salma::slam {

void CPathHistory::add(TPastStep step) {
    const double before = m_steps.empty() ? 0 : m_steps.back().travel;
    step.travel = before + step.increment.head<2>().norm();
    m_steps.push_back(std::move(step));
}

void CPathHistory::rename(int gone, int kept) {
    for (TPastStep& step : m_steps)
        for (TUsedMeasurement& used : step.used)
            if (used.landmark == gone) used.landmark = kept;
}

void CPathHistory::erase(int landmark) {
    for (TPastStep& step : m_steps)
        step.used.erase(
            std::remove_if(step.used.begin(), step.used.end(),
                           [landmark](const auto& used) { return used.landmark == landmark; }),
            step.used.end());
}

std::map<int, std::pair<std::size_t, std::size_t>> CPathHistory::steps() const {
    std::map<int, std::pair<std::size_t, std::size_t>> result;
    for (std::size_t k = 0; k < m_steps.size(); ++k)
        for (const TUsedMeasurement& used : m_steps[k].used)
            result.insert({used.landmark, {k, k}}).first->second.second = k;
    return result;
}

}  // namespace salma::slam
