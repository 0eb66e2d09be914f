// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>

#include <optional>
#include <string>
#include <vector>

#include "CLogArchive.h"

namespace salma::observations {

/// What a rawlog holds, in the order of the file: observations, sensory frames, actions.
struct TRawObjects {
    std::vector<mrpt::serialization::CSerializable::Ptr> objects;
    std::size_t count{0};  //!< Of objects that were read, also of those no longer kept.
    bool truncated{false};
    double lastGoodTime{0};  //!< [s] of the last whole record that has a stamp.
};

/// \throw std::runtime_error as readLog() does.
TRawObjects readObjects(const std::string& file, bool acceptTruncated);

/** Reads the object that comes now to the end of `read.objects`.
 * \return false where the log breaks off in it. \throw std::runtime_error as readLog() does. */
bool readNext(CLogArchive& in, TRawObjects& read);

/// Stamp [s since 1970]; nothing where the record has none.
std::optional<double> timeOf(const mrpt::obs::CObservation& observation);

}  // namespace salma::observations
