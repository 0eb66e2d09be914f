// SPDX-License-Identifier: BSD-3-Clause
#include "leaveOneOut.h"

#include <salma/association/CJointInnovation.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <limits>

namespace salma::association {

template <int DIM>
TLeaveOneOut leaveOneOut(const TAssociationProblemOf<DIM>& problem,
                         const std::vector<TBranch>& pairings) {
    if (pairings.empty()) return {};
    const auto size = static_cast<Eigen::Index>(DIM * pairings.size());
    Eigen::MatrixXd S(size, size);
    Eigen::VectorXd nu(size);
    for (std::size_t a = 0; a < pairings.size(); ++a) {
        const auto& measurement = problem.measurements[pairings[a].observation];
        const auto row = static_cast<Eigen::Index>(DIM * a);
        nu.segment<DIM>(row) = innovation(measurement.z, problem.landmarks[pairings[a].landmark].z);
        for (std::size_t b = 0; b < pairings.size(); ++b)
            S.block<DIM, DIM>(row, static_cast<Eigen::Index>(DIM * b)) =
                problem.predictionCovariance.template block<DIM, DIM>(
                    static_cast<Eigen::Index>(DIM * pairings[a].landmark),
                    static_cast<Eigen::Index>(DIM * pairings[b].landmark));
        S.block<DIM, DIM>(row, row) += measurement.R;
    }
    const double infinity = std::numeric_limits<double>::infinity();
    const Eigen::LLT<Eigen::MatrixXd> factor(S);
    if (factor.info() != Eigen::Success)
        return {std::vector<double>(pairings.size(), infinity), infinity};
    const Eigen::MatrixXd information = factor.solve(Eigen::MatrixXd::Identity(size, size));
    const Eigen::VectorXd weighted = information * nu;
    TLeaveOneOut result;
    result.jointDistance2 = nu.dot(weighted);
    for (Eigen::Index row = 0; row < size; row += DIM) {
        const TReading<DIM> own = weighted.segment<DIM>(row);
        result.distance2.push_back(own.dot(information.block<DIM, DIM>(row, row).inverse() * own));
    }
    return result;
}

template TLeaveOneOut leaveOneOut<2>(const TAssociationProblem&, const std::vector<TBranch>&);
template TLeaveOneOut leaveOneOut<3>(const TAssociationProblem3D&, const std::vector<TBranch>&);

}  // namespace salma::association
