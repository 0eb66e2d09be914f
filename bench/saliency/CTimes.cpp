// SPDX-License-Identifier: BSD-3-Clause
#include "CTimes.h"

#include <algorithm>
#include <stdexcept>

namespace salma::bench {

void CTimes::ReportRuns(const std::vector<Run>& runs) {
    for (const auto& run : runs) {
        if (run.error_occurred)
            throw std::runtime_error(run.run_name.function_name + ": " + run.error_message);
        if (run.run_type != Run::RT_Iteration) continue;
        const double seconds = run.real_accumulated_time / static_cast<double>(run.iterations);
        const auto counter = run.counters.find("regions");
        const double regions = counter == run.counters.end() ? 0 : counter->second.value;
        const auto [at, isNew] = m_times.emplace(run.run_name.function_name,
                                                 TTime{seconds, static_cast<std::size_t>(regions)});
        if (!isNew) at->second.seconds = std::min(at->second.seconds, seconds);
    }
}

std::optional<TTime> CTimes::find(const std::string& name) const {
    const auto at = m_times.find(name);
    return at == m_times.end() ? std::nullopt : std::optional<TTime>(at->second);
}

}  // namespace salma::bench
