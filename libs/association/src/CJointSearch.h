// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <random>

#include "CChiSquareGate.h"
#include "CInterpretationTree.h"

namespace salma::association {

/// Pairings of a hypothesis, as indices of the tree's branches.
struct TJointHypothesis {
    std::vector<std::size_t> branches;
    double distance2{0};
};

/// Searches the jointly compatible hypothesis with most pairings, then smallest joint distance.
template <int DIM>
class CJointSearch {
 public:
    /// Both must outlive this object. \param tree Its branches pass the individual gate.
    CJointSearch(CInterpretationTree<DIM>& tree, const CChiSquareGate& gate);

    /// Depth first with a sound bound. \return False if `tests` were not enough.
    bool branchAndBound(std::size_t tests);

    /// Improves on the best hypothesis by random starts. \param tests Stops after so many.
    void randomised(std::size_t tests, std::uint32_t seed);

    const TJointHypothesis& best() const { return m_best; }

 private:
    /// A branch that the path leaves possible.
    struct TSurvivor {
        std::size_t branch{0};
        double distance2{0};  //!< Given the path.
    };
    /// Observations that are still to be explained, each with its survivors, the nearest first.
    using TFront = std::vector<std::vector<TSurvivor>>;

    TFront rootFront() const;
    TFront tested(const TFront& front);
    void explore(TFront front);
    std::size_t bound(const TFront& front);
    bool promises(const TFront& front, std::size_t bound) const;
    void consider();
    TJointHypothesis bestOf(const TFront& few, std::size_t tests);
    void addNearest(const std::vector<TSurvivor>& survivors);
    std::size_t descendAll(const TJointHypothesis& hypothesis);
    void ascendTo(std::size_t depth);

    CInterpretationTree<DIM>& m_tree;
    const CChiSquareGate& m_gate;
    std::vector<std::size_t> m_path;  //!< Branches from the root to where the tree stands.
    TJointHypothesis m_best;
    std::size_t m_lastTest{0};            //!< Of the tree's count, after which the search ends.
    std::vector<std::size_t> m_lastSeen;  //!< By landmark, for bound().
    std::size_t m_looks{0};
};

}  // namespace salma::association
