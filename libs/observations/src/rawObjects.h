// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>

#include <optional>
#include <string>
#include <vector>

namespace salma::observations {

/// What a rawlog holds, in the order of the file: observations, sensory frames, actions.
struct TRawObjects {
    std::vector<mrpt::serialization::CSerializable::Ptr> objects;
    bool truncated{false};
    double lastGoodTime{0};  //!< [s] of the last whole record that has a stamp.
};

/// \throw std::runtime_error as readLog() does.
TRawObjects readObjects(const std::string& file, bool acceptTruncated);

/// Stamp [s since 1970]; nothing where the record has none.
std::optional<double> timeOf(const mrpt::obs::CObservation& observation);

}  // namespace salma::observations
