// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <proportion.h>

#include <vector>

#include "labelledRun.h"

namespace salma::apps {

/// How often a poster in view was taken by the front end, by incidence and range.
struct TDetectionCell {
    double incidenceFrom{0}, incidenceTo{0};  //!< [rad]
    double rangeFrom{0}, rangeTo{0};          //!< [m]; the last is infinite.
    TProportion seen;
};

/// Cells with at least one view, by incidence, then range.
std::vector<TDetectionCell> detection(const std::vector<TLabelledRun>& runs);

}  // namespace salma::apps
