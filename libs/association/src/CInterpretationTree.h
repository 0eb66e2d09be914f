// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationProblem.h>

#include <cstdint>
#include <vector>

#include "CWhitener.h"

namespace salma::association {

/// A pairing that a hypothesis may contain.
struct TBranch {
    std::size_t observation{0};
    std::size_t landmark{0};
};

/// A branch, given the pairings on the path; infinite where its covariance is not sound.
struct TBranchTest {
    double distance2{0};  //!< Its share of the joint squared Mahalanobis distance.
    double logPeak{0};    //!< Log density of an innovation of zero.
};

/** Walks over hypotheses; the pairings of the current one are the path from the root.
 *
 * Each branch keeps its coupling with the pairings of the path, whitened by their joint Cholesky
 * factor, level by level. A test costs O(1) for each level that the branch has not yet met, so at
 * most O(d) with d pairings, and going up costs nothing: levels are dropped when they are
 * next looked at. Source: Neira and Tardos, IEEE T-RA 17(6), 2001, for the incremental test. */
template <int DIM>
class CInterpretationTree {
 public:
    /** `problem` must outlive this object.
     * \param given Pairings that every hypothesis contains and that are not counted in it. */
    CInterpretationTree(const TAssociationProblemOf<DIM>& problem,
                        const std::vector<TBranch>& branches,
                        const std::vector<TBranch>& given);

    std::size_t size() const { return m_given; }
    const TBranch& operator[](std::size_t index) const { return m_branches[index].branch; }

    TBranchTest test(std::size_t index);

    /// Innovation of a branch and its covariance, as the test just made found them.
    const TReading<DIM>& value(std::size_t index) const {
        return m_branches[index].levels.back().value;
    }
    const TReadingCovariance<DIM>& covariance(std::size_t index) const {
        return m_branches[index].levels.back().covariance;
    }

    /// \return False, and nothing changed, where test() finds infinity.
    bool descend(std::size_t index);
    void ascend();

    /// Pairings on the path, without the given ones.
    std::size_t depth() const { return m_path.size() - m_root; }
    /// Of the pairings on the path together, given the given ones.
    double distance2() const { return distanceAt(m_path.size()) - distanceAt(m_root); }
    bool isTaken(std::size_t landmark) const { return m_taken[landmark]; }

    std::size_t nodes() const { return m_nodes; }  //!< Times of descent.
    std::size_t tests() const { return m_tests; }

 private:
    /// A branch as the first pairings of the path leave it.
    struct TLevel {
        std::uint64_t stamp{0};  //!< Of the pairing that made it.
        TReadingCovariance<DIM> coupling{
            TReadingCovariance<DIM>::Zero()};  //!< With that pairing, whitened.
        TReadingCovariance<DIM> covariance{TReadingCovariance<DIM>::Zero()};
        TReading<DIM> value{TReading<DIM>::Zero()};  //!< Innovation [m, rad].
    };
    struct TState {
        TBranch branch;
        std::vector<TLevel> levels;  //!< The first one is the root's, without coupling.
    };
    /// A pairing of the path.
    struct TPairing {
        std::size_t index{0};
        std::uint64_t stamp{0};
        CWhitener<DIM> whitener;  //!< Of its covariance.
        TReading<DIM> whitened;
        double distance2{0};  //!< Of the path so far.
    };

    double distanceAt(std::size_t depth) const {
        return depth == 0 ? 0 : m_path[depth - 1].distance2;
    }
    void append(const TBranch& branch);
    const TLevel& current(std::size_t index);
    void extend(TState& state) const;

    const TAssociationProblemOf<DIM>& m_problem;
    std::vector<TState> m_branches;  //!< The given ones last.
    std::size_t m_given;             //!< Index of the first given one.
    std::vector<TPairing> m_path;
    std::vector<bool> m_taken;  //!< By landmark.
    std::size_t m_root{0};      //!< Given pairings on the path.
    std::uint64_t m_stamp{0};
    std::size_t m_nodes{0};
    std::size_t m_tests{0};
};

}  // namespace salma::association
