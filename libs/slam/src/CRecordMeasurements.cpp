// SPDX-License-Identifier: BSD-3-Clause
#include "CRecordMeasurements.h"

#include <salma/slam/CSharedParts.h>
#include <salma/slam/salientMeasurement.h>

#include <stdexcept>

namespace salma::slam {

using observations::CObservationSalientLandmarks;

namespace {

constexpr std::size_t kKept = 8;  // a step has a few records at most

}  // namespace

bool CRecordMeasurements::TKey::operator==(const TKey& other) const {
    return timestamp == other.timestamp && sensorLabel == other.sensorLabel &&
           corners == other.corners && places == other.places;
}

CRecordMeasurements& CRecordMeasurements::instance() {
    static CRecordMeasurements measurements;
    return measurements;
}

CRecordMeasurements::TKey CRecordMeasurements::keyOf(const CObservationSalientLandmarks& record) {
    TKey key{record.timestamp, record.sensorLabel, {}, {}};
    for (const auto& patch : record.landmarks) {
        key.corners.insert(key.corners.end(), patch.quad.begin(), patch.quad.end());
        key.places.push_back(patch.pose.mean.translation());
    }
    return key;
}

Measurements CRecordMeasurements::of(const CObservationSalientLandmarks& record) {
    const TKey key = keyOf(record);
    const std::lock_guard<std::mutex> lock(m_mutex);
    for (const auto& [known, measurements] : m_last)
        if (known == key) return measurements;
    auto made = std::make_shared<std::vector<association::TMeasurement>>();
    for (const auto& patch : record.landmarks) {
        if (!(patch.pose.mean.translation().norm() > 0)) continue;
        const auto shared = std::make_shared<const observations::TPatch>(patch);
        CSharedParts<observations::TPatch>::instance().numberOf(shared);
        made->push_back(measurementOf(shared));
    }
    m_last.emplace_front(key, made);
    if (m_last.size() > kKept) m_last.pop_back();
    return made;
}

}  // namespace salma::slam
