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

}  // namespace salma::slam
