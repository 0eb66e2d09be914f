// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationProblem.h>

#include <optional>
#include <vector>

namespace salma::bench {

struct TMrptOutcome {
    std::vector<int> landmarks;  //!< By observation, -1 for none.
    std::size_t nodes{0};
    double seconds{0};  //!< Processor time.
};

/** What MRPT's JCBB makes of the problem, by Mahalanobis distance at 0.99 and without its kd-tree,
 * which can miss compatible pairings. It runs in a child process: it may not end.
 * \return Nothing if it took more than `limit` seconds and was killed.
 * \throw std::system_error if no process can be started. */
std::optional<TMrptOutcome> mrptJcbb(const association::TAssociationProblem& problem, double limit);

}  // namespace salma::bench
