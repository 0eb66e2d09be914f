// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationOptions.h>
#include <salma/association/TAssociationProblem.h>

#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace salma::association::test {

struct TExhaustiveResult {
    std::vector<int> landmarks;  //!< By measurement, -1 for none.
    double distance2{0};
    std::size_t pairings{0};
    std::size_t individuallyCompatible{0};  //!< Measurements with a landmark in their gate.
};

/// A hypothesis by its score, as CSaliencyAssociation has it.
struct TScoredResult {
    std::vector<int> landmarks;   //!< By measurement, -1 for none.
    double score{0};              //!< Less log(1 - P_D) of all landmarks.
    std::vector<bool> ambiguous;  //!< By measurement: the margin is not kept.
};

/** Looks at every hypothesis of a small problem, each from scratch: the oracle of the searches.
 *
 * Shares nothing with them: whole matrices are inverted, and the gates are written down below. */
template <int DIM>
class CExhaustiveSearch {
 public:
    explicit CExhaustiveSearch(const TAssociationProblemOf<DIM>& problem);

    /// Most pairings, then smallest joint distance, among those inside both gates of 99 %.
    TExhaustiveResult mostPairings();

    /// Largest score, and which measurements another hypothesis within the margin explains
    /// otherwise.
    TScoredResult bestScored(const TAssociationOptions& options);

 private:
    void visit(std::size_t observation, const std::function<void()>& consider);
    void dropForbidden(const TAssociationOptions& options);
    double score(const TAssociationOptions& options);
    bool isNear(std::size_t observation, const TAssociationOptions& options);
    void consider();
    double distance2() const;
    double logDeterminant() const;
    Eigen::MatrixXd covariance() const;

    const TAssociationProblemOf<DIM>& m_problem;
    std::vector<std::vector<int>> m_candidates;  //!< By measurement.
    std::vector<int> m_now;
    TExhaustiveResult m_best;
    std::map<std::pair<std::size_t, int>, double> m_ratios;  //!< By measurement and landmark.
};

}  // namespace salma::association::test
