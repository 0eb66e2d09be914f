// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "CTimes.h"
#include "TCase.h"
#include "TWork.h"

namespace salma::bench {

/// A case that was run. What cannot be told since the other case was not run is NaN.
struct TSpeedRow {
    TCase which;
    std::size_t regions{0};
    double ms{0};
    double bySift{0};       //!< Times that of SIFT with as many threads.
    double byMser{0};       //!< Times that of MSER with as many threads.
    double plainBy{0};      //!< Time of the plain loops, all peaks, by this one.
    double oneThreadBy{0};  //!< Time of one thread by this one.
    double cycles{0};  //!< For each centre (ours and plain loops) or pixel, all threads' together.
};

/// \param clock [Hz] In the order of `cases`, without those that were not run.
std::vector<TSpeedRow> speedRows(const std::vector<TCase>& cases,
                                 const CTimes& times,
                                 double clock);

/// Markdown, a table for each picture and size.
void printSpeed(const std::vector<TSpeedRow>& rows, std::ostream& out);

/// \throw std::runtime_error if the file cannot be written.
void writeSpeedCsv(const std::vector<TSpeedRow>& rows, const std::string& file);

/// The least and the measured cycles of a picture with an instruction set.
struct TBoundRow {
    std::string picture;
    std::string set;
    TWork work;
    TBound bound;
    double measured{0};  //!< Cycles for each centre.
};

/// Markdown.
void printBounds(const std::vector<TBoundRow>& rows, std::ostream& out);

/** \throw std::runtime_error if ways that must give the same peaks gave different numbers of
 * peaks. */
void checkSameCounts(const std::vector<TSpeedRow>& rows);

}  // namespace salma::bench
