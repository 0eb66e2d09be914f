// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/blockFilter.h>
#include <salma/slam/rangeBearingModel.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>
#include <string>

namespace salma::slam {
namespace {

constexpr Eigen::Index poseSize = 3;

Eigen::Index rowOf(std::size_t landmark) {
    return poseSize + 2 * static_cast<Eigen::Index>(landmark);
}

/// P H' of one measurement [n x 2]. P is symmetric: its rows lie together in memory, its columns
/// do not.
Eigen::MatrixX2d crossCovariance(const Eigen::Ref<const RowMatrix>& covariance,
                                 const TSighting& expected,
                                 Eigen::Index row) {
    return (expected.byPose * covariance.topRows<poseSize>() +
            expected.byLandmark * covariance.middleRows<2>(row))
        .transpose();
}

/// H X of one measurement [2 x columns of X].
Eigen::Matrix2Xd projected(const TSighting& expected,
                           const Eigen::Ref<const Eigen::MatrixXd>& cross,
                           Eigen::Index row) {
    return expected.byPose * cross.topRows<poseSize>() +
           expected.byLandmark * cross.middleRows<2>(row);
}

}  // namespace

void predict(TFilterState state, const Eigen::Vector3d& increment, const Eigen::Matrix3d& Q) {
    auto& P = state.covariance;
    const TMotion motion = moved(state.mean.head<poseSize>(), increment);
    const Eigen::Index others = state.mean.size() - poseSize;
    const Eigen::Matrix3d pose = P.topLeftCorner<poseSize, poseSize>();
    state.mean.head<poseSize>() = motion.pose;
    Eigen::Matrix3d grown = motion.byPose * pose * motion.byPose.transpose() +
                            motion.byIncrement * Q * motion.byIncrement.transpose();
    P.topLeftCorner<poseSize, poseSize>() = 0.5 * (grown + grown.transpose());
    P.topRightCorner(poseSize, others) =
        (motion.byPose * P.topRightCorner(poseSize, others)).eval();
    P.bottomLeftCorner(others, poseSize) = P.topRightCorner(poseSize, others).transpose();
}

/* For a thousand landmarks this is the longest part of a step, and bound by memory: both products
 * run along the rows. */
Eigen::MatrixXd predictionCovariance(const Eigen::VectorXd& mean, const RowMatrix& covariance) {
    const Eigen::Index count = (mean.size() - poseSize) / 2;
    std::vector<TSighting> expected;
    for (Eigen::Index k = 0; k < count; ++k)
        expected.push_back(sighting(mean.head<poseSize>(), mean.segment<2>(rowOf(k))));
    Eigen::MatrixXd result(2 * count, 2 * count);
    RowMatrix cross(2, mean.size());  // H P of one landmark
    for (Eigen::Index k = 0; k < count; ++k) {
        cross.noalias() = expected[k].byPose * covariance.topRows<poseSize>() +
                          expected[k].byLandmark * covariance.middleRows<2>(rowOf(k));
        const Eigen::Matrix<double, 2, poseSize> byPose = cross.leftCols<poseSize>();
        for (Eigen::Index j = 0; j <= k; ++j) {
            const Eigen::Matrix2d both =
                byPose * expected[j].byPose.transpose() +
                Eigen::Matrix2d(cross.middleCols<2>(rowOf(j))) * expected[j].byLandmark.transpose();
            result.block<2, 2>(2 * j, 2 * k) = both.transpose();
            result.block<2, 2>(2 * k, 2 * j) = both;
        }
        result(2 * k, 2 * k + 1) = result(2 * k + 1, 2 * k);
    }
    return result;
}

void update(TFilterState state, const std::vector<TPairedMeasurement>& measurements) {
    const auto count = static_cast<Eigen::Index>(measurements.size());
    if (count == 0) return;
    Eigen::MatrixXd cross(state.mean.size(), 2 * count);
    Eigen::VectorXd residual(2 * count);
    std::vector<TSighting> expected;
    for (Eigen::Index k = 0; k < count; ++k) {
        const TPairedMeasurement& m = measurements[k];
        const Eigen::Index row = rowOf(m.landmark);
        expected.push_back(sighting(state.mean.head<poseSize>(), state.mean.segment<2>(row)));
        cross.middleCols<2>(2 * k) = crossCovariance(state.covariance, expected.back(), row);
        residual[2 * k] = m.z[0] - expected.back().z[0];
        residual[2 * k + 1] = mrpt::math::wrapToPi(m.z[1] - expected.back().z[1]);
    }
    Eigen::MatrixXd S(2 * count, 2 * count);
    for (Eigen::Index k = 0; k < count; ++k) {
        S.middleRows<2>(2 * k) = projected(expected[k], cross, rowOf(measurements[k].landmark));
        S.block<2, 2>(2 * k, 2 * k) += measurements[k].R;
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(S);
    if (factor.info() != Eigen::Success)
        throw std::runtime_error("Innovation covariance of " + std::to_string(count) +
                                 " measurements is not positive definite");
    // W = P H' L^-T, so that K S K' = W W' and K nu = W (L^-1 nu).
    const Eigen::MatrixXd W = factor.matrixL().solve(cross.transpose()).transpose();
    const Eigen::VectorXd step = W * factor.matrixL().solve(residual);
    if (!step.allFinite() || !W.allFinite())
        throw std::runtime_error("Update by " + std::to_string(count) +
                                 " measurements is not finite");
    state.mean += step;
    state.mean[2] = mrpt::math::wrapToPi(state.mean[2]);
    state.covariance.selfadjointView<Eigen::Lower>().rankUpdate(W, -1.0);
    state.covariance.triangularView<Eigen::StrictlyUpper>() =
        state.covariance.transpose().triangularView<Eigen::StrictlyUpper>();
}

void anchorAtRobot(TFilterState state) {
    auto& P = state.covariance;
    const Eigen::Index size = P.rows();
    // A landmark's error as seen from the robot: its own, less what the robot's error moves it by.
    Eigen::MatrixX3d byPose = Eigen::MatrixX3d::Zero(size, 3);
    for (Eigen::Index row = poseSize; row < size; row += 2) {
        const Eigen::Vector2d arm = state.mean.segment<2>(row) - state.mean.head<2>();
        byPose.middleRows<2>(row) << 1, 0, -arm.y(), 0, 1, arm.x();
    }
    const Eigen::Matrix3d pose = P.topLeftCorner<poseSize, poseSize>();
    const Eigen::MatrixX3d cross = P.leftCols<poseSize>();
    P -= cross * byPose.transpose() + byPose * cross.transpose();
    P += byPose * pose * byPose.transpose();
    P.topRows<poseSize>().setZero();
    P.leftCols<poseSize>().setZero();
    P = (0.5 * (P + P.transpose())).eval();
}

Eigen::Matrix3d carried(const Eigen::Matrix3d& covariance,
                        const Eigen::Vector3d& base,
                        const Eigen::Vector3d& pose) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
    A(0, 2) = -(pose[1] - base[1]);
    A(1, 2) = pose[0] - base[0];
    return A * covariance * A.transpose();
}

void initializeLast(TFilterState state, const Eigen::Vector2d& z, const Eigen::Matrix2d& R) {
    const TLocated found = located(state.mean.head<poseSize>(), z);
    const Eigen::Index row = state.mean.size() - 2;
    auto& P = state.covariance;
    state.mean.tail<2>() = found.landmark;
    P.bottomLeftCorner(2, row) = found.byPose * P.topLeftCorner(poseSize, row);
    P.topRightCorner(row, 2) = P.bottomLeftCorner(2, row).transpose();
    const Eigen::Matrix2d own =
        found.byPose * P.topLeftCorner<poseSize, poseSize>() * found.byPose.transpose() +
        found.byMeasurement * R * found.byMeasurement.transpose();
    P.bottomRightCorner<2, 2>() = 0.5 * (own + own.transpose());
}

}  // namespace salma::slam
