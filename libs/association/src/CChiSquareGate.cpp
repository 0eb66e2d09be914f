// SPDX-License-Identifier: BSD-3-Clause
#include "CChiSquareGate.h"

#include <boost/math/distributions/chi_squared.hpp>

namespace salma::association {

double chiSquareQuantile(double probability, unsigned degreesOfFreedom) {
    return boost::math::quantile(boost::math::chi_squared(degreesOfFreedom), probability);
}

CChiSquareGate::CChiSquareGate(double probability, unsigned dof, std::size_t pairings)
    : m_limits{0} {
    for (unsigned count = 1; count <= pairings; ++count)
        m_limits.push_back(chiSquareQuantile(probability, dof * count));
}

}  // namespace salma::association
