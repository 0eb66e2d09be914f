// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/CDataAssociator.h>

namespace salma::association {

/** Joint compatibility branch and bound (JCBB): of all hypotheses whose pairings are compatible
 * each by itself and all together, the one with most pairings, then with the smallest joint
 * distance.
 *
 * The joint gate, chi-square at `jointQuantile` with two degrees of freedom a pairing, is asked of
 * the whole hypothesis; the paper asks it of each partial one too, which makes the result depend on
 * the order of the measurements. Pairings by identity are taken for granted: the others are judged
 * given them. Where the search does not end within `searchLimit` tests, randomised joint
 * compatibility goes on and the better hypothesis counts. Appearance is not looked at.
 * Source: Neira and Tardos, IEEE T-RA 17(6), 2001; Paz, Tardos and Neira, IEEE T-RO 24(5), 2008,
 * for the random starts. */
class CJointCompatibility : public CDataAssociator {
 public:
    /// \throw std::invalid_argument
    explicit CJointCompatibility(const TAssociationOptions& options = {});

    TAssociation associate(const TAssociationProblem& problem) const override;
    TAssociation associate(const TAssociationProblem3D& problem) const override;

 private:
    template <int DIM>
    TAssociation associateIn(const TAssociationProblemOf<DIM>& problem) const;

    TAssociationOptions m_options;
};

}  // namespace salma::association
