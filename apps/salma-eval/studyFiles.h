// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "studyTable.h"

namespace salma::apps {

/// The rows with every figure, its counts and its interval of 95 %.
std::string studyCsv(const std::vector<TStudyRow>& rows);
std::string studyJson(const std::vector<TStudyRow>& rows, const TStudyLimits& limits);
/// The main figures for a reader, and what they mean.
std::string studyMarkdown(const std::vector<TStudyRow>& rows, const TStudyLimits& limits);

/// One row for each run, and its processor time apart: all but that is the same each time.
std::string runsCsv(const std::vector<TRunResult>& results, const TStudyLimits& limits);
std::string timesCsv(const std::vector<TRunResult>& results);

/** Draws as PNG: shares of success with their intervals; how the errors of the last lap are
 * distributed; ANEES over the course. Groups of all worlds together where there are several.
 * \throw std::runtime_error as viz::CGnuplot */
void plotSuccess(const std::vector<TStudyRow>& rows, const std::string& file);
void plotErrors(const std::vector<TStudyRow>& rows,
                const TStudyLimits& limits,
                const std::string& file);
void plotConsistency(const std::vector<TStudyRow>& rows, const std::string& file);

}  // namespace salma::apps
