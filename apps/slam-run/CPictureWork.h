// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/landmarks/CLandmarkRecorder.h>
#include <salma/observations/CLogReader.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "TSlamConfig.h"

namespace salma::apps {

/// What the front end made of all pictures of a log.
struct TSeen {
    /// One record per picture that could be read, in the order of the log.
    std::vector<observations::CObservationSalientLandmarks::Ptr> records;
    std::size_t pictures{0};         //!< Pictures in the log, whether or not they could be used.
    std::size_t filesMissing{0};     //!< Their files are gone.
    std::size_t withoutScan{0};      //!< No scan within `max_skew_s`.
    std::size_t withoutHeadPose{0};  //!< The log has pan/tilt records, but none near in time.
    std::size_t alreadyRecorded{0};  //!< The log has their record.
    std::map<std::string, std::size_t> refused;  //!< Sum of the front end's refusals.
    std::size_t split{0};                        //!< Groups of regions on several planes.
};

/** Sends every picture of a log through the front end.
 *
 * A picture is joined with the scan nearest in time, whose lines are moved to the picture's time by
 * odometry, and with the pose of the camera at that time. Pictures are independent of each other:
 * they are worked on in parallel and the result is the same for any number of threads. */
class CPictureWork {
 public:
    /// `log` must outlive this object.
    CPictureWork(const TSlamConfig& config, const observations::TLog& log);

    /** \throw std::runtime_error if a picture file is there but cannot be read. */
    TSeen run() const;

 private:
    std::vector<landmarks::TJoinedPicture> jobs(TSeen& seen) const;
    bool join(landmarks::TJoinedPicture& job, TSeen& seen) const;

    const TSlamConfig& m_config;
    const observations::TLog& m_log;
    landmarks::CLandmarkRecorder m_recorder;
};

}  // namespace salma::apps
