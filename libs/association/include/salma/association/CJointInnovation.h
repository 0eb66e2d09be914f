// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationProblem.h>

#include <cmath>
#include <optional>

namespace salma::association {

/// Measured minus predicted: range [m] and angles, wrapped to within half a turn [rad].
Eigen::Vector2d innovation(const Eigen::Vector2d& measured, const Eigen::Vector2d& predicted);
Eigen::Vector3d innovation(const Eigen::Vector3d& measured, const Eigen::Vector3d& predicted);

/// Integral of exp(-d2 / 2) for unit covariance: (2 pi)^(DIM / 2).
template <int DIM>
double gaussNorm() {
    return std::pow(2 * M_PI, 0.5 * DIM);
}

/// How well one more pairing agrees with those chosen before.
template <int DIM>
struct TConditionalInnovationOf {
    double distance2{0};   //!< Its share of the joint squared Mahalanobis distance.
    double logDensity{0};  //!< Of the measurement, given the pairings before.
    TReading<DIM> value;   //!< Innovation that the pairings before leave unexplained [m, rad].
    TReadingCovariance<DIM> factor;  //!< Lower Cholesky factor of its covariance.
};

/** The pairings of a hypothesis with their joint innovation covariance, grown one by one.
 *
 * Holds the Cholesky factor of S = H P H' + R over the pairings, so that the test of one more costs
 * O(d^2) with d pairings. With no pairings the test is the individual one.
 * Source: Neira and Tardos, IEEE T-RA 17(6), 2001, section III (joint compatibility). */
template <int DIM>
class CJointInnovationOf {
 public:
    /// `problem` must outlive this object.
    explicit CJointInnovationOf(const TAssociationProblemOf<DIM>& problem);

    /// Nothing if the covariance is not positive definite or the innovation not finite.
    std::optional<TConditionalInnovationOf<DIM>> test(std::size_t observation,
                                                      std::size_t landmark) const;

    /// Adds a pairing. \return False, and nothing changed, where test() finds nothing.
    bool add(std::size_t observation, std::size_t landmark);

    double distance2() const { return m_whitened.squaredNorm(); }
    std::size_t pairings() const { return m_landmarks.size(); }

 private:
    /// Covariance of a landmark's prediction with those of the pairings, whitened [DIM d x DIM].
    Eigen::MatrixXd coupling(std::size_t landmark) const;

    const TAssociationProblemOf<DIM>& m_problem;
    std::vector<std::size_t> m_landmarks;  //!< Of the pairings, in the order of addition.
    Eigen::MatrixXd m_factor;              //!< Lower Cholesky factor of S [DIM d x DIM d].
    Eigen::VectorXd m_whitened;            //!< Innovations, whitened by it [DIM d].
};

using TConditionalInnovation = TConditionalInnovationOf<2>;
using CJointInnovation = CJointInnovationOf<2>;

}  // namespace salma::association
