// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/CDataAssociator.h>
#include <salma/association/CJointInnovation.h>

#include <vector>

#include "CInterpretationTree.h"

namespace salma::association {

/// A landmark that a measurement could show.
struct TPair {
    std::size_t landmark{0};
    double distance2{0};  //!< By itself, whatever else is paired.
    double logRatio{std::numeric_limits<double>::quiet_NaN()};
    bool inGate{false};
    bool forbidden{false};  //!< Excluded by appearance.
};

/** The association of one step while a method works on it: what all methods have in common.
 *
 * Construction checks the problem, sorts out clutter, pairs by identity and gates the rest. The
 * method then pairs what it wants and settles every other open measurement. */
template <int DIM>
class CGatedStep {
 public:
    /// \throw std::invalid_argument, see CDataAssociator::associate().
    CGatedStep(const TAssociationOptions& options, const TAssociationProblemOf<DIM>& problem);

    /// Landmarks within `newDistance2` of a measurement that could be it, sorted by index; empty
    /// for one that identity or clutter decided.
    const std::vector<TPair>& pairs(std::size_t observation) const { return m_pairs[observation]; }
    bool isOpen(std::size_t observation) const { return m_open[observation]; }
    bool isTaken(std::size_t landmark) const { return m_taken[landmark]; }
    std::size_t openCount() const;
    /// Pairs that no test forbids, of all open measurements, sorted.
    std::vector<TBranch> branches(bool outsideGateToo = false) const;
    /// \param branch Must be one of the measurement's pairs.
    const TPair& pairOf(const TBranch& branch) const;
    const std::vector<TBranch>& identityPairings() const { return m_identities; }
    const CJointInnovationOf<DIM>& joint() const { return m_joint; }
    /// True if the joint gate holds with one more pairing. Pairings by identity are taken for
    /// granted: the others are judged given them.
    bool passesJointGate(const TConditionalInnovationOf<DIM>& more) const;
    TDropCounts& dropped() { return m_result.dropped; }

    /// Asks the appearance of every pair that has one and marks what it forbids.
    void weighAppearance();

    /// `landmark` must be one of the measurement's pairs.
    void pair(std::size_t observation, std::size_t landmark, EReason reason);

    /// For an open measurement that no method wants to pair any more; counts what failed jointly.
    EReason whyUnpaired(std::size_t observation);

    void defer(std::size_t observation, EReason reason);

    /** Makes an open measurement a new landmark if it is clear of all that it could be, else defers
     * it for `reason`. \param givenPairings Distances are judged given the pairings made. */
    void settle(std::size_t observation, EReason reason, bool givenPairings);

    /// Call once, when every measurement is decided.
    TAssociation finish(const TSearchCounts& search = {});

 private:
    void rejectClutter();
    void refuseExcess();
    void pairIdentities();
    void gate(std::size_t observation);
    bool compatible(const TMeasurementOf<DIM>& measurement,
                    const TPredictedLandmarkOf<DIM>& landmark);
    bool isNear(std::size_t observation, const TPair& pair, bool givenPairings) const;
    void decide(std::size_t observation, EVerdict verdict, EReason reason);

    const TAssociationOptions& m_options;
    const TAssociationProblemOf<DIM>& m_problem;
    double m_gate;       //!< chi2 with DIM degrees of freedom
    double m_wallGate2;  //!< chi2 with 1 degree of freedom
    CJointInnovationOf<DIM> m_joint;
    double m_identityDistance2{0};  //!< Share of the pairings by identity in the joint distance.
    std::vector<TBranch> m_identities;
    TAssociation m_result;
    std::vector<std::vector<TPair>> m_pairs;
    std::vector<bool> m_open;
    std::vector<bool> m_taken;
};

}  // namespace salma::association
