// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "TCalibrationOptions.h"
#include "labelledPairs.h"

namespace salma::apps {

struct TAngleBin {
    double from{0}, to{0};  //!< Change of the viewing angle [rad].
    std::size_t pairs{0};   //!< Pairs of views of one track, against one view of the map each.
    /// Of their log ratios; NaN where there are too few pairs.
    double correlation{std::numeric_limits<double>::quiet_NaN()};
    /// The same as it never rises with the change.
    double fitted{std::numeric_limits<double>::quiet_NaN()};
};

struct TDecorrelation {
    std::vector<TAngleBin> bins;
    /// Smallest change whose fitted correlation is within the limit [rad]; nothing if none is.
    std::optional<double> angle;
    std::size_t tracks{0};
};

/** How long two views of one track say the same against the map.
 *
 * A track is one poster seen without a gap of more than `trackGap`. All pairs of views of a track
 * are compared with each view that another track of the poster left, and their log ratios are
 * correlated (Pearson) by the change of viewing angle. What all views of a poster have in common is
 * part of the correlation: the table does not know it either. Correlations that rise with the
 * change are noise and are pooled.
 * \param pairs By run. \param logRatio Of a pair, by the table. */
TDecorrelation decorrelation(const std::vector<TLabelledRun>& runs,
                             const std::vector<std::vector<TLabelledPair>>& pairs,
                             const std::function<double(const TLabelledPair&)>& logRatio,
                             const TCalibrationOptions& options);

}  // namespace salma::apps
