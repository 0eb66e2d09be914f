// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace salma::appearance {

/// \throw std::invalid_argument naming `section` if the knots are no monotone table over [0, 1].
void checkTable(const std::vector<double>& scores,
                const std::vector<double>& logRatios,
                const std::string& section);

/// Piecewise linear between the knots; `score` is clamped to [0, 1].
double readTable(const std::vector<double>& scores,
                 const std::vector<double>& logRatios,
                 double score);

/** The ratio once a share of the others looks the same: p(score|other) is then a mixture, and the
 * result stays below -log(duplicateRate). */
double withDuplicates(double logRatio, double duplicateRate);

}  // namespace salma::appearance
