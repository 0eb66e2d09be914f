// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>

#include <chrono>
#include <map>
#include <mutex>
#include <vector>

namespace salma::apps {

/** Records of all sensors between their arrival and the file, put in order of their stamps.
 *
 * Each waits for a fixed time after its arrival, so that older ones of slower sensors can pass it.
 * That time runs by the steady clock: stamps that jump back, or lie in the future, keep nothing
 * waiting for longer. Any thread may call. */
class CPendingRecords {
 public:
    using TTime = std::chrono::steady_clock::time_point;
    using TRecord = mrpt::serialization::CSerializable::Ptr;

    void add(const mrpt::hwdrivers::CGenericSensor::TListObservations& records, TTime arrival);

    /// Those that arrived by `until`, and all with older stamps, in order of stamps.
    std::vector<TRecord> take(TTime until);
    /// All that there are.
    std::vector<TRecord> takeAll() { return take(TTime::max()); }

 private:
    struct TEntry {
        TRecord record;
        TTime arrival;
    };
    std::mutex m_mutex;
    std::multimap<mrpt::Clock::time_point, TEntry> m_records;
};

}  // namespace salma::apps
