// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationProblem.h>

#include <optional>

namespace salma::association {

/// Measured minus predicted: range [m] and bearing, wrapped to within half a turn [rad].
Eigen::Vector2d innovation(const Eigen::Vector2d& measured, const Eigen::Vector2d& predicted);

/// How well one more pairing agrees with those chosen before.
struct TConditionalInnovation {
    double distance2{0};     //!< Its share of the joint squared Mahalanobis distance.
    double logDensity{0};    //!< Of the measurement, given the pairings before [1/(m rad)].
    Eigen::Vector2d value;   //!< Innovation that the pairings before leave unexplained [m, rad].
    Eigen::Matrix2d factor;  //!< Lower Cholesky factor of its covariance.
};

/** The pairings of a hypothesis with their joint innovation covariance, grown one by one.
 *
 * Holds the Cholesky factor of S = H P H' + R over the pairings, so that the test of one more costs
 * O(d^2) with d pairings. With no pairings the test is the individual one.
 * Source: Neira and Tardos, IEEE T-RA 17(6), 2001, section III (joint compatibility). */
class CJointInnovation {
 public:
    /// `problem` must outlive this object.
    explicit CJointInnovation(const TAssociationProblem& problem);

    /// Nothing if the covariance is not positive definite or the innovation not finite.
    std::optional<TConditionalInnovation> test(std::size_t observation, std::size_t landmark) const;

    /// Adds a pairing. \return False, and nothing changed, where test() finds nothing.
    bool add(std::size_t observation, std::size_t landmark);

    double distance2() const { return m_whitened.squaredNorm(); }
    std::size_t pairings() const { return m_landmarks.size(); }

 private:
    /// Covariance of a landmark's prediction with those of the pairings, whitened [2d x 2].
    Eigen::MatrixXd coupling(std::size_t landmark) const;

    const TAssociationProblem& m_problem;
    std::vector<std::size_t> m_landmarks;  //!< Of the pairings, in the order of addition.
    Eigen::MatrixXd m_factor;              //!< Lower Cholesky factor of S [2d x 2d].
    Eigen::VectorXd m_whitened;            //!< Innovations, whitened by it [2d].
};

}  // namespace salma::association
