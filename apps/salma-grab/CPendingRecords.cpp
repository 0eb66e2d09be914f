// SPDX-License-Identifier: BSD-3-Clause
#include "CPendingRecords.h"

#include <algorithm>

namespace salma::apps {

void CPendingRecords::add(const mrpt::hwdrivers::CGenericSensor::TListObservations& records,
                          TTime arrival) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    for (const auto& [stamp, record] : records)
        if (record) m_records.emplace(stamp, TEntry{record, arrival});
}

std::vector<CPendingRecords::TRecord> CPendingRecords::take(TTime until) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    const auto last =
        std::find_if(m_records.rbegin(), m_records.rend(),
                     [until](const auto& entry) { return entry.second.arrival <= until; });
    std::vector<TRecord> taken;
    for (auto entry = m_records.begin(); entry != last.base(); ++entry)
        taken.push_back(entry->second.record);
    m_records.erase(m_records.begin(), last.base());
    return taken;
}

}  // namespace salma::apps
