// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/association/CJointInnovation.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace salma::association {

Eigen::Vector2d innovation(const Eigen::Vector2d& measured, const Eigen::Vector2d& predicted) {
    return {measured[0] - predicted[0], mrpt::math::wrapToPi(measured[1] - predicted[1])};
}

Eigen::Vector3d innovation(const Eigen::Vector3d& measured, const Eigen::Vector3d& predicted) {
    return {measured[0] - predicted[0], mrpt::math::wrapToPi(measured[1] - predicted[1]),
            mrpt::math::wrapToPi(measured[2] - predicted[2])};
}

template <int DIM>
CJointInnovationOf<DIM>::CJointInnovationOf(const TAssociationProblemOf<DIM>& problem)
    : m_problem(problem) {}

template <int DIM>
Eigen::MatrixXd CJointInnovationOf<DIM>::coupling(std::size_t landmark) const {
    const Eigen::Index size = m_whitened.size();
    Eigen::MatrixXd cross(size, DIM);
    for (std::size_t k = 0; k < m_landmarks.size(); ++k)
        cross.middleRows<DIM>(DIM * k) = m_problem.predictionCovariance.template block<DIM, DIM>(
            DIM * m_landmarks[k], DIM * landmark);
    if (size > 0) m_factor.triangularView<Eigen::Lower>().solveInPlace(cross);
    return cross;
}

template <int DIM>
std::optional<TConditionalInnovationOf<DIM>> CJointInnovationOf<DIM>::test(
    std::size_t observation, std::size_t landmark) const {
    const TMeasurementOf<DIM>& measurement = m_problem.measurements[observation];
    const Eigen::MatrixXd cross = coupling(landmark);
    TReadingCovariance<DIM> covariance =
        m_problem.predictionCovariance.template block<DIM, DIM>(DIM * landmark, DIM * landmark) +
        measurement.R;
    covariance.noalias() -= cross.transpose() * cross;
    TConditionalInnovationOf<DIM> result;
    result.value = innovation(measurement.z, m_problem.landmarks[landmark].z);
    result.value.noalias() -= cross.transpose() * m_whitened;
    const Eigen::LLT<TReadingCovariance<DIM>> factor(covariance);
    if (factor.info() != Eigen::Success) return {};
    result.factor = factor.matrixL();
    const double determinant = result.factor.diagonal().prod();  // square root of |covariance|
    result.distance2 = factor.matrixL().solve(result.value).squaredNorm();
    result.logDensity = -0.5 * result.distance2 - std::log(gaussNorm<DIM>() * determinant);
    if (!std::isfinite(result.logDensity)) return {};
    return result;
}

template <int DIM>
bool CJointInnovationOf<DIM>::add(std::size_t observation, std::size_t landmark) {
    const auto tested = test(observation, landmark);
    if (!tested) return false;
    const Eigen::MatrixXd cross = coupling(landmark);
    const Eigen::Index size = m_whitened.size();
    m_factor.conservativeResize(size + DIM, size + DIM);
    m_factor.topRightCorner(size, DIM).setZero();
    m_factor.bottomLeftCorner(DIM, size) = cross.transpose();
    m_factor.bottomRightCorner<DIM, DIM>() = tested->factor;
    m_whitened.conservativeResize(size + DIM);
    m_whitened.tail<DIM>() =
        tested->factor.template triangularView<Eigen::Lower>().solve(tested->value);
    m_landmarks.push_back(landmark);
    return true;
}

template class CJointInnovationOf<2>;
template class CJointInnovationOf<3>;

}  // namespace salma::association
