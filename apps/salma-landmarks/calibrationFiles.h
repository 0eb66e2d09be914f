// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "CCalibration.h"

namespace salma::apps {

/// Sections with what was learned, to be pasted into a config.ini or used as one.
std::string calibrationIni(const TCalibration& calibration);

/// Figures as JSON.
std::string calibrationJson(const TCalibration& calibration);

/// What the program prints.
std::string calibrationTable(const TCalibration& calibration);

/** Tables, each with a header line: bins of both ratio tables; all pairs; predicted against counted
 * ratios; correlation by change of viewing angle; share of posters seen. */
std::string binsCsv(const TCalibration& calibration);
std::string pairsCsv(const TCalibration& calibration);  //!< Every pair, to look closer.
std::string reliabilityCsv(const TCalibration& calibration);
std::string decorrelationCsv(const TCalibration& calibration);
std::string detectionCsv(const TCalibration& calibration);

/** Both tables with what was counted, and the correlation.
 * \throw std::runtime_error naming the file */
void plotTables(const TCalibration& calibration, const std::string& file);

/// Predicted against counted log ratios, of learning and held-out runs. \throw std::runtime_error
void plotReliability(const TCalibration& calibration, const std::string& file);

}  // namespace salma::apps
