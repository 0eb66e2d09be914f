// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/CLogReader.h>
#include <salma/observations/CObservationSalientLandmarks.h>

#include <string>
#include <vector>

namespace salma::observations {

/// Front-end records to be written, in any order; their stamps are those of the pictures.
using TSalientRecords = std::vector<CObservationSalientLandmarks::Ptr>;

/** Writes `records` to a companion file of `log`, as single observations in order of time.
 *
 * Companions of action/SF logs too hold single observations, as all stock programs show these;
 * readLog() puts each into the sensory frame nearest in time. What the present companion of `log`
 * holds besides CObservationSalientLandmarks (such as pan/tilt states) is kept. Gzip; written
 * beside `file` and moved into place, so `file` may be the present companion.
 * \throw std::runtime_error naming the file that cannot be read or written. */
void saveCompanion(const TLog& log, const TSalientRecords& records, const std::string& file);

/** Writes the whole log and `records` to one file, in the log's own format.
 *
 * The log is read again from TLog::file, so nothing of it is lost but what was broken off, and
 * CObservationSalientLandmarks that it or its companion held: `records` take their place. In an
 * action/SF log each record goes to the sensory frame nearest in time. Only programs with the
 * plug-in can read the result. External pictures stay external: they are looked for in `Y_Images`
 * beside `Y.rawlog`. Gzip; written beside `file` and moved into place. \throw std::runtime_error */
void saveEmbedded(const TLog& log, const TSalientRecords& records, const std::string& file);

}  // namespace salma::observations
