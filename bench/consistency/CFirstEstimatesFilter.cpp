// SPDX-License-Identifier: BSD-3-Clause
#include "CFirstEstimatesFilter.h"

#include <mrpt/math/wrap2pi.h>
#include <salma/association/CJointInnovation.h>
#include <salma/slam/rangeBearingModel.h>

#include <Eigen/Cholesky>
#include <stdexcept>

namespace salma::bench {
namespace {

/// Derivative of R(phi) p by phi, for p turned already.
Eigen::Vector2d byTurn(const Eigen::Vector2d& p) { return {-p.y(), p.x()}; }

}  // namespace

CFirstEstimatesFilter::CFirstEstimatesFilter()
    : m_mean(Eigen::VectorXd::Zero(3)),
      m_covariance(Eigen::MatrixXd::Zero(3, 3)),
      m_predicted(Eigen::Vector3d::Zero()) {}

void CFirstEstimatesFilter::process(const slam::TStepInput& step) {
    predict(step);
    update(step);
    for (const auto& m : step.measurements)
        if (m_rows.count(*m.identity) == 0) enter(m);
}

void CFirstEstimatesFilter::predict(const slam::TStepInput& step) {
    const auto& mean = step.increment.mean;
    auto motion = slam::moved(m_mean.head<3>(), {mean.x(), mean.y(), mean.phi()});
    // From prediction to prediction, whatever the update between them changed.
    motion.byPose.block<2, 1>(0, 2) = byTurn(motion.pose.head<2>() - m_predicted.head<2>());
    const Eigen::Matrix3d pose = covariance();
    const Eigen::Index others = m_mean.size() - 3;
    m_covariance.topLeftCorner<3, 3>() =
        motion.byPose * pose * motion.byPose.transpose() +
        motion.byIncrement * step.increment.cov.asEigen() * motion.byIncrement.transpose();
    m_covariance.topRightCorner(3, others) =
        (motion.byPose * m_covariance.topRightCorner(3, others)).eval();
    m_covariance.bottomLeftCorner(others, 3) = m_covariance.topRightCorner(3, others).transpose();
    m_mean.head<3>() = m_predicted = motion.pose;
}

void CFirstEstimatesFilter::update(const slam::TStepInput& step) {
    std::vector<const association::TMeasurement*> known;
    for (const auto& m : step.measurements) {
        if (!m.identity) throw std::invalid_argument("A measurement has no identity");
        if (m_rows.count(*m.identity) != 0) known.push_back(&m);
    }
    const auto size = static_cast<Eigen::Index>(2 * known.size());
    if (size == 0) return;
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, m_mean.size());
    Eigen::MatrixXd R = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd nu(size);
    for (Eigen::Index k = 0; k < size; k += 2) {
        const auto& m = *known[static_cast<std::size_t>(k / 2)];
        const Eigen::Index row = m_rows.at(*m.identity);
        nu.segment<2>(k) = association::innovation(
            m.z, slam::sighting(m_mean.head<3>(), m_mean.segment<2>(row)).z);
        const auto linear = slam::sighting(m_predicted, m_first.at(*m.identity));
        H.block<2, 3>(k, 0) = linear.byPose;
        H.block<2, 2>(k, row) = linear.byLandmark;
        R.block<2, 2>(k, k) = m.R;
    }
    const Eigen::MatrixXd cross = m_covariance * H.transpose();
    const Eigen::LLT<Eigen::MatrixXd> factor(H * cross + R);
    const Eigen::MatrixXd W = factor.matrixL().solve(cross.transpose()).transpose();
    m_mean += W * factor.matrixL().solve(nu);
    m_mean[2] = mrpt::math::wrapToPi(m_mean[2]);
    m_covariance -= W * W.transpose();
}

void CFirstEstimatesFilter::enter(const association::TMeasurement& measurement) {
    const auto found = slam::located(m_mean.head<3>(), measurement.z);
    auto byPose = found.byPose;
    byPose.col(2) = byTurn(found.landmark - m_predicted.head<2>());
    const Eigen::Index row = m_mean.size();
    m_mean.conservativeResize(row + 2);
    m_mean.tail<2>() = found.landmark;
    m_covariance.conservativeResize(row + 2, row + 2);
    m_covariance.bottomLeftCorner(2, row) = byPose * m_covariance.topLeftCorner(3, row);
    m_covariance.topRightCorner(row, 2) = m_covariance.bottomLeftCorner(2, row).transpose();
    m_covariance.bottomRightCorner<2, 2>() =
        byPose * covariance() * byPose.transpose() +
        found.byMeasurement * measurement.R * found.byMeasurement.transpose();
    m_rows[*measurement.identity] = row;
    m_first[*measurement.identity] = found.landmark;
}

}  // namespace salma::bench
