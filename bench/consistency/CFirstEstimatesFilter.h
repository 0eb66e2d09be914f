// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/CSlamBackend.h>

#include <Eigen/Core>
#include <map>

namespace salma::bench {

/** EKF-SLAM with first-estimates Jacobians, for measurements with identities.
 *
 * Derivatives are taken at the predicted pose and at each landmark's first place, so that the
 * linearised system cannot observe what the true one cannot: the place and heading of the whole
 * map. Source: G. P. Huang, A. I. Mourikis, S. I. Roumeliotis, "Analysis and Improvement of the
 * Consistency of Extended Kalman Filter based SLAM", ICRA 2008, section IV. */
class CFirstEstimatesFilter {
 public:
    CFirstEstimatesFilter();

    /// \throw std::invalid_argument for a measurement without identity.
    void process(const slam::TStepInput& step);

    Eigen::Vector3d pose() const { return m_mean.head<3>(); }
    Eigen::Matrix3d covariance() const { return m_covariance.topLeftCorner<3, 3>(); }

 private:
    void predict(const slam::TStepInput& step);
    void update(const slam::TStepInput& step);
    void enter(const association::TMeasurement& measurement);

    Eigen::VectorXd m_mean;  //!< Pose, then (x, y) of each landmark.
    Eigen::MatrixXd m_covariance;
    Eigen::Vector3d m_predicted;             //!< The pose before the last update.
    std::map<int, Eigen::Index> m_rows;      //!< By identity.
    std::map<int, Eigen::Vector2d> m_first;  //!< Where a landmark was first put, by identity.
};

}  // namespace salma::bench
