// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/CDataAssociator.h>

namespace salma::association {

/** Sequential compatibility nearest neighbour (SCNN): a nearest neighbour is kept only if it is
 * jointly compatible with the pairings before it, chi-square at `jointQuantile`.
 *
 * Measurements with the fewest possible pairings go first: a wrong pairing at the start would make
 * the right ones look impossible. A measurement whose nearest free landmark fails the joint
 * test is not paired at all. Appearance is not looked at.
 * Source: Neira and Tardos, IEEE T-RA 17(6), 2001, section III; the order is ours. */
class CSequentialCompatibility : public CDataAssociator {
 public:
    /// \throw std::invalid_argument
    explicit CSequentialCompatibility(const TAssociationOptions& options = {});

    TAssociation associate(const TAssociationProblem& problem) const override;
    TAssociation associate(const TAssociationProblem3D& problem) const override;

 private:
    template <int DIM>
    TAssociation associateIn(const TAssociationProblemOf<DIM>& problem) const;

    TAssociationOptions m_options;
};

}  // namespace salma::association
