// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationProblem.h>

#include <vector>

namespace salma::association::test {

struct TExhaustiveResult {
    std::vector<int> landmarks;  //!< By measurement, -1 for none.
    double distance2{0};
    std::size_t pairings{0};
    std::size_t individuallyCompatible{0};  //!< Measurements with a landmark in their gate.
};

/** Looks at every hypothesis of a small problem, each from scratch: the oracle of the searches.
 *
 * Shares nothing with them: whole matrices are inverted, and the gates are written down below. */
class CExhaustiveSearch {
 public:
    explicit CExhaustiveSearch(const TAssociationProblem& problem);

    /// Most pairings, then smallest joint distance, among those inside both gates of 99 %.
    TExhaustiveResult mostPairings();

 private:
    void visit(std::size_t observation);
    void consider();
    double distance2() const;

    const TAssociationProblem& m_problem;
    std::vector<std::vector<int>> m_candidates;  //!< By measurement.
    std::vector<int> m_now;
    TExhaustiveResult m_best;
};

}  // namespace salma::association::test
