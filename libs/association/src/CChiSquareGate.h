// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace salma::association {

/// Quantile of the chi-square distribution. \param probability Between 0 and 1.
double chiSquareQuantile(double probability, unsigned degreesOfFreedom);

/// Largest joint squared Mahalanobis distance of a number of pairings.
class CChiSquareGate {
 public:
    /// \param dof Degrees of freedom of one pairing.
    /// \param pairings The largest number that will be asked for.
    CChiSquareGate(double probability, unsigned dof, std::size_t pairings);

    double operator()(std::size_t pairings) const { return m_limits[pairings]; }

 private:
    std::vector<double> m_limits;  //!< By the number of pairings; 0 for none.
};

}  // namespace salma::association
