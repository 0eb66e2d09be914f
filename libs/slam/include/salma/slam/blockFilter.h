// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace salma::slam {

/// Covariance as MRPT stores it.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/** State of a range-bearing filter, held elsewhere: pose (x, y, heading), then (x, y) of each
 * landmark [3 + 2N], [m, rad], and its covariance. */
struct TFilterState {
    Eigen::Ref<Eigen::VectorXd> mean;
    Eigen::Ref<RowMatrix> covariance;
};

/// A measurement of a landmark that is in the state.
struct TPairedMeasurement {
    std::size_t landmark{0};                         //!< Index, 0 for the first.
    Eigen::Vector2d z{0, 0};                         //!< Range [m] and bearing [rad].
    Eigen::Matrix2d R{Eigen::Matrix2d::Identity()};  //!< Its covariance.
};

/// Moves the robot by `increment` = (x, y, turn) with covariance Q, both in its frame [m, rad].
void predict(TFilterState state, const Eigen::Vector3d& increment, const Eigen::Matrix3d& Q);

/// H P H' of the predicted measurements of all N landmarks together [2N x 2N].
Eigen::MatrixXd predictionCovariance(const Eigen::VectorXd& mean, const RowMatrix& covariance);

/** Updates by all measurements at once: P - K S K' is formed from the Cholesky factor of S as a
 * symmetric rank-2m update, O(n^2 m), so P stays symmetric.
 * \throw std::runtime_error if S is not positive definite or the new state not finite; the state
 * is then unchanged. */
void update(TFilterState state, const std::vector<TPairedMeasurement>& measurements);

/// Fills the last landmark of the state, which has been enlarged for it, from one measurement.
void initializeLast(TFilterState state, const Eigen::Vector2d& z, const Eigen::Matrix2d& R);

/** States the covariance from where the robot is: its pose becomes exact, and landmarks keep what
 * is unsure between them and it. The mean stays as it is.
 *
 * A filter whose heading is unsure in the world by more than a degree or two takes derivatives at
 * headings that differ, and so believes to have learned its heading; seen from the robot nothing is
 * unsure that the derivatives depend on. To first order nothing is lost but the covariance of the
 * pose, which the caller keeps. Source: Castellanos, Martinez-Cantin, Tardos and Neira, Robotics
 * and Autonomous Systems 55(1), 2007 (robocentric mapping); as a change of datum: Baarda, 1973. */
void anchorAtRobot(TFilterState state);

/// Covariance of a pose by that of an earlier one, `base`, where both moved rigidly.
Eigen::Matrix3d carried(const Eigen::Matrix3d& covariance,
                        const Eigen::Vector3d& base,
                        const Eigen::Vector3d& pose);

}  // namespace salma::slam
