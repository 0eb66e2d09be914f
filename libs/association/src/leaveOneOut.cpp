// SPDX-License-Identifier: BSD-3-Clause
#include "leaveOneOut.h"

#include <salma/association/CJointInnovation.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <limits>

namespace salma::association {

TLeaveOneOut leaveOneOut(const TAssociationProblem& problem, const std::vector<TBranch>& pairings) {
    if (pairings.empty()) return {};
    const auto size = static_cast<Eigen::Index>(2 * pairings.size());
    Eigen::MatrixXd S(size, size);
    Eigen::VectorXd nu(size);
    for (std::size_t a = 0; a < pairings.size(); ++a) {
        const auto& measurement = problem.measurements[pairings[a].observation];
        const auto row = static_cast<Eigen::Index>(2 * a);
        nu.segment<2>(row) = innovation(measurement.z, problem.landmarks[pairings[a].landmark].z);
        for (std::size_t b = 0; b < pairings.size(); ++b)
            S.block<2, 2>(row, static_cast<Eigen::Index>(2 * b)) =
                problem.predictionCovariance.block<2, 2>(
                    static_cast<Eigen::Index>(2 * pairings[a].landmark),
                    static_cast<Eigen::Index>(2 * pairings[b].landmark));
        S.block<2, 2>(row, row) += measurement.R;
    }
    const double infinity = std::numeric_limits<double>::infinity();
    const Eigen::LLT<Eigen::MatrixXd> factor(S);
    if (factor.info() != Eigen::Success)
        return {std::vector<double>(pairings.size(), infinity), infinity};
    const Eigen::MatrixXd information = factor.solve(Eigen::MatrixXd::Identity(size, size));
    const Eigen::VectorXd weighted = information * nu;
    TLeaveOneOut result;
    result.jointDistance2 = nu.dot(weighted);
    for (Eigen::Index row = 0; row < size; row += 2) {
        const Eigen::Vector2d own = weighted.segment<2>(row);
        result.distance2.push_back(own.dot(information.block<2, 2>(row, row).inverse() * own));
    }
    return result;
}

}  // namespace salma::association
