// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationProblem.h>
#include <salma/slam/TSlipOptions.h>

#include <vector>

namespace salma::slam {

/** Distances along the motion that would lay tracked landmarks onto measurements.
 *
 * \param tracked By landmark of the problem.
 * \param direction Of the motion, unit vector, robot frame.
 * \return At most three [m], that with most pairs first; each has `leastPairs` at least. */
std::vector<double> slipProposals(const TSlipOptions& options,
                                  const association::TAssociationProblem& problem,
                                  const std::vector<bool>& tracked,
                                  const Eigen::Vector2d& direction,
                                  std::size_t leastPairs);

}  // namespace salma::slam
