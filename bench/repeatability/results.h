// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "CRepeatabilityBench.h"

namespace salma::bench {

/// One line for each row. \throw std::runtime_error if the file cannot be written.
void writeCsv(const std::vector<TBenchRow>& rows, const std::string& file);

/** Tables for people: of each set, detectors at their operating points against pictures.
 * \throw std::runtime_error if the file cannot be written. */
void writeMarkdown(const std::vector<TBenchRow>& rows,
                   const CRepeatabilityBench& bench,
                   const std::string& file);

/// One panel of a figure.
struct TPanel {
    std::string set;
    std::string point;
    std::string title;
};

/** Both forms of repeatability over the pictures, panels side by side, as a PNG.
 * \throw std::runtime_error if gnuplot is missing or fails, or the file cannot be written. */
void plotRepeatability(const std::vector<TBenchRow>& rows,
                       const std::vector<TPanel>& panels,
                       const std::string& file);

}  // namespace salma::bench
