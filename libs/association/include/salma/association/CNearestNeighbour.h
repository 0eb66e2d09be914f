// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/CDataAssociator.h>

namespace salma::association {

/** Pairs each measurement with the nearest landmark inside its individual gate.
 *
 * The nearest pair of all goes first, so where two measurements want one landmark the nearer gets
 * it. Appearance is not looked at. Source: own. */
class CNearestNeighbour : public CDataAssociator {
 public:
    /// \throw std::invalid_argument
    explicit CNearestNeighbour(const TAssociationOptions& options = {});

    TAssociation associate(const TAssociationProblem& problem) const override;
    TAssociation associate(const TAssociationProblem3D& problem) const override;

 private:
    template <int DIM>
    TAssociation associateIn(const TAssociationProblemOf<DIM>& problem) const;

    TAssociationOptions m_options;
};

}  // namespace salma::association
