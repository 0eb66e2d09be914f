// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TMeasurement.h>
#include <salma/observations/CObservationSalientLandmarks.h>

#include <deque>
#include <memory>
#include <mutex>
#include <vector>

namespace salma::slam {

using Measurements = std::shared_ptr<const std::vector<association::TMeasurement>>;

/** The measurements of the records that were asked for last.
 *
 * Every particle asks for the same record, twice or more, and a patch with its picture and
 * descriptors is too large to copy each time. Safe to use from several threads. */
class CRecordMeasurements {
 public:
    static CRecordMeasurements& instance();

    /// Patches that lie at the robot's origin are left out.
    Measurements of(const observations::CObservationSalientLandmarks& record);

 private:
    /// What tells two records apart without looking at every byte.
    struct TKey {
        mrpt::Clock::time_point timestamp;
        std::string sensorLabel;
        std::vector<mrpt::math::TPoint2D> corners;
        std::vector<mrpt::math::TPoint3D> places;
        bool operator==(const TKey& other) const;
    };
    static TKey keyOf(const observations::CObservationSalientLandmarks& record);

    std::mutex m_mutex;
    std::deque<std::pair<TKey, Measurements>> m_last;  //!< Newest first.
};

}  // namespace salma::slam
