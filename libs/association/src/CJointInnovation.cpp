// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/association/CJointInnovation.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace salma::association {

Eigen::Vector2d innovation(const Eigen::Vector2d& measured, const Eigen::Vector2d& predicted) {
    return {measured[0] - predicted[0], mrpt::math::wrapToPi(measured[1] - predicted[1])};
}

CJointInnovation::CJointInnovation(const TAssociationProblem& problem) : m_problem(problem) {}

Eigen::MatrixXd CJointInnovation::coupling(std::size_t landmark) const {
    const Eigen::Index size = m_whitened.size();
    Eigen::MatrixXd cross(size, 2);
    for (std::size_t k = 0; k < m_landmarks.size(); ++k)
        cross.middleRows<2>(2 * k) =
            m_problem.predictionCovariance.block<2, 2>(2 * m_landmarks[k], 2 * landmark);
    if (size > 0) m_factor.triangularView<Eigen::Lower>().solveInPlace(cross);
    return cross;
}

std::optional<TConditionalInnovation> CJointInnovation::test(std::size_t observation,
                                                             std::size_t landmark) const {
    const TMeasurement& measurement = m_problem.measurements[observation];
    const Eigen::MatrixXd cross = coupling(landmark);
    Eigen::Matrix2d covariance =
        m_problem.predictionCovariance.block<2, 2>(2 * landmark, 2 * landmark) + measurement.R;
    covariance.noalias() -= cross.transpose() * cross;
    TConditionalInnovation result;
    result.value = innovation(measurement.z, m_problem.landmarks[landmark].z);
    result.value.noalias() -= cross.transpose() * m_whitened;
    const Eigen::LLT<Eigen::Matrix2d> factor(covariance);
    if (factor.info() != Eigen::Success) return {};
    result.factor = factor.matrixL();
    const double determinant = result.factor.diagonal().prod();  // square root of |covariance|
    result.distance2 = factor.matrixL().solve(result.value).squaredNorm();
    result.logDensity = -0.5 * result.distance2 - std::log(2 * M_PI * determinant);
    if (!std::isfinite(result.logDensity)) return {};
    return result;
}

bool CJointInnovation::add(std::size_t observation, std::size_t landmark) {
    const auto tested = test(observation, landmark);
    if (!tested) return false;
    const Eigen::MatrixXd cross = coupling(landmark);
    const Eigen::Index size = m_whitened.size();
    m_factor.conservativeResize(size + 2, size + 2);
    m_factor.topRightCorner(size, 2).setZero();
    m_factor.bottomLeftCorner(2, size) = cross.transpose();
    m_factor.bottomRightCorner<2, 2>() = tested->factor;
    m_whitened.conservativeResize(size + 2);
    m_whitened.tail<2>() = tested->factor.triangularView<Eigen::Lower>().solve(tested->value);
    m_landmarks.push_back(landmark);
    return true;
}

}  // namespace salma::association
