// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/TDetectionOptions.h>

#include <cstddef>
#include <vector>

#include "TCalibrationOptions.h"
#include "labelledRun.h"

namespace salma::apps {

/// How well a table says what is found.
struct TDetectionLoss {
    std::size_t views{0}, found{0};
    double learned{0};     //!< Mean -log p(found or not) by the learned tables [nat].
    double configured{0};  //!< The same by those of the configuration.
};

/** Learns the tables of [detection] from views of known truth.
 *
 * The product of both tables, times the probability that the view shows the thing at all, is fitted
 * to what was found: the most likely values at the knots of `configured`, all others linear in
 * between. Of one thing `perPoster` views at most count between two neighbouring knots, however
 * often it was seen from there; `priorCount` views, of which as many were found as of all, less
 * the more slanting they are, keep each knot from certainty. `spoiltRate` of the posters' views are
 * taken to be spoilt, as no simulated one is. Source: own.
 * \return The values of `configured` for a kind of which there is no view. */
slam::TDetectionOptions learnDetection(const std::vector<TLabelledRun>& runs,
                                       const slam::TDetectionOptions& configured,
                                       const TCalibrationOptions& options);

/// On views that show the thing for sure or not, as they come.
TDetectionLoss detectionLoss(const std::vector<TLabelledRun>& runs,
                             association::ELandmarkKind kind,
                             const slam::TDetectionOptions& learned,
                             const slam::TDetectionOptions& configured);

}  // namespace salma::apps
