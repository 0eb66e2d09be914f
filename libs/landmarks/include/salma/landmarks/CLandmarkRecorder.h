// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/landmarks/CFrontEnd.h>
#include <salma/landmarks/joinPicture.h>
#include <salma/laser/CLineExtractor.h>
#include <salma/laser/CPlaceString.h>

#include <string>

namespace salma::landmarks {

/// What a picture's record is made with, one ini section each.
struct TRecorderOptions {
    laser::TLineOptions lines;
    laser::TPlaceStringOptions placeString;
    TSeeingOptions seeing;
};

/// A record, and what the front end says of it.
struct TRecorded {
    observations::CObservationSalientLandmarks::Ptr record;  //!< Never null.
    TFrontEndResult result;  //!< Its landmarks have moved to the record.
};

/** From a picture and its scan to the record of its landmarks: what salma-slam does with a log and
 * CSalientLandmarkSensor on the robot. Const is safe from several threads. */
class CLandmarkRecorder {
 public:
    /// \throw std::invalid_argument if options are out of range.
    explicit CLandmarkRecorder(const TRecorderOptions& options = {});

    /** \param imagesFolder Where external pictures lie, TLog::imagesFolder.
     * \throw std::runtime_error naming the file if the picture cannot be read
     * \throw std::invalid_argument if it is not of its camera's size. */
    TRecorded record(const TJoinedPicture& job, const std::string& imagesFolder) const;

 private:
    CFrontEnd m_frontEnd;
    laser::CLineExtractor m_lines;
    laser::CPlaceString m_placeString;
};

}  // namespace salma::landmarks
