// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociation.h>
#include <salma/association/TAssociationOptions.h>
#include <salma/association/TAssociationProblem.h>

#include <memory>

namespace salma::association {

/** Decides which landmark of the map each measurement of a step shows, if any.
 *
 * Common to all methods: a measurement whose identity the log states is paired with the landmark
 * of that identity without a gate; if there is none it may still be a landmark without identity. A
 * landmark is paired at most once. Two landmarks of different kind, convexity, identity or wall are
 * never paired. What is not paired makes a new landmark only if it is clearly apart from every
 * landmark that it could be; otherwise it is deferred. Angles are compared across the half turn.
 * The result does not depend on the order of measurements or landmarks, exact ties aside. */
class CDataAssociator {
 public:
    virtual ~CDataAssociator() = default;

    /** \return One decision per measurement; without landmarks all that are sound are new.
     * \throw std::invalid_argument if the covariance's size does not fit the landmarks or one of
     * its entries is not finite. */
    virtual TAssociation associate(const TAssociationProblem& problem) const = 0;
    virtual TAssociation associate(const TAssociationProblem3D& problem) const = 0;
};

/// The associator that `options.method` names. \throw std::invalid_argument for bad options.
std::unique_ptr<CDataAssociator> createAssociator(const TAssociationOptions& options);

}  // namespace salma::association
