// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CPatchMatcher.h>

#include <optional>
#include <vector>

namespace salma::appearance {

/// One point in the frames of two patches [m].
struct TPointPair {
    double ax{0}, ay{0};
    double bx{0}, by{0};
};

/// Least squares over all pairs; nothing if they do not determine it.
std::optional<TSimilarity> fitSimilarity(const std::vector<TPointPair>& pairs);

/** The fit with the covariance that its residuals tell; nothing for fewer than 3 pairs or for pairs
 * that do not determine it. */
std::optional<TRelativePose> relativePose(const std::vector<TPointPair>& pairs);

/** Adds what all pairs share: the errors (e_u, e_v, turn) of each patch's metric, as metricErrors()
 * has them, about the middle of the patch. For similarities near to a shift. */
void addPatchErrors(const std::vector<TPointPair>& pairs,
                    const Eigen::Matrix3d& ofA,
                    const Eigen::Matrix3d& ofB,
                    TRelativePose& pose);

}  // namespace salma::appearance
