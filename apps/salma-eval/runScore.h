// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CTruthMatcher.h>
#include <TTruth.h>
#include <salma/slam/TRunRecord.h>

#include <map>
#include <vector>

#include "CAssociationScore.h"
#include "TRunScore.h"

namespace salma::apps {

/// How each kind of landmark was associated in a run.
std::map<association::ELandmarkKind, TAssociationFigures> associationFigures(
    const std::vector<slam::TAssociationRow>& rows,
    const TTruth& truth,
    const CTruthMatcher& matcher);

/** Compares a run with the truth of its log.
 * \param laps Of the true path; the last one is the last 1/laps of its length.
 * \throw std::invalid_argument if the truth has no path, or fewer than two poses at the times of
 * the run. */
TRunScore scoreRun(const slam::TRunRecord& record, const TTruth& truth, int laps);

}  // namespace salma::apps
