// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/blockFilter.h>
#include <salma/slam/rangeBearingModel.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <limits>
#include <random>
#include <stdexcept>

namespace salma::slam {
namespace {

/// A pose and three landmarks with a full covariance.
class BlockFilter : public ::testing::Test {
 protected:
    BlockFilter() : mean(9), covariance(9, 9) {
        mean << 0.5, -0.2, 0.3, 4, 1, 2, -3, -3, 2;
        std::mt19937 random(5);
        std::normal_distribution<double> unit(0, 1);
        RowMatrix root(9, 9);
        for (double& value : root.reshaped()) value = 0.05 * unit(random);
        covariance = root * root.transpose() + 1e-4 * RowMatrix::Identity(9, 9);
    }

    TFilterState state() { return {mean, covariance}; }

    /// H of the measurements of the given landmarks [2m x 9].
    Eigen::MatrixXd jacobian(const std::vector<std::size_t>& landmarks) const {
        Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2 * landmarks.size(), 9);
        for (std::size_t k = 0; k < landmarks.size(); ++k) {
            const std::size_t row = 3 + 2 * landmarks[k];
            const TSighting seen = sighting(mean.head<3>(), mean.segment<2>(row));
            H.block<2, 3>(2 * k, 0) = seen.byPose;
            H.block<2, 2>(2 * k, row) = seen.byLandmark;
        }
        return H;
    }

    Eigen::VectorXd mean;
    RowMatrix covariance;
};

TEST_F(BlockFilter, PredictsLikeTheFullMatrices) {
    const Eigen::Vector3d increment(0.4, 0.1, 0.2);
    Eigen::Matrix3d Q = Eigen::Vector3d(0.01, 0.02, 0.003).asDiagonal();
    Q(0, 1) = Q(1, 0) = 0.004;
    const TMotion motion = moved(mean.head<3>(), increment);
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(9, 9);
    F.topLeftCorner<3, 3>() = motion.byPose;
    Eigen::MatrixXd expected = F * covariance * F.transpose();
    expected.topLeftCorner<3, 3>() += motion.byIncrement * Q * motion.byIncrement.transpose();
    const Eigen::VectorXd landmarks = mean.tail<6>();
    predict(state(), increment, Q);
    EXPECT_TRUE(covariance.isApprox(expected, 1e-12));
    EXPECT_TRUE(mean.head<3>().isApprox(motion.pose, 1e-12));
    EXPECT_EQ(mean.tail<6>(), landmarks);
}

TEST_F(BlockFilter, PredictsTheCovarianceOfAllMeasurements) {
    const Eigen::MatrixXd H = jacobian({0, 1, 2});
    EXPECT_TRUE(
        predictionCovariance(mean, covariance).isApprox(H * covariance * H.transpose(), 1e-12));
}

TEST_F(BlockFilter, UpdatesLikeTheTextbookFormWithAnOwnCovariancePerMeasurement) {
    const std::vector<std::size_t> landmarks{2, 0};
    std::vector<TPairedMeasurement> paired;
    Eigen::VectorXd residual(4);
    residual << 0.03, -0.02, 0.01, 0.05;
    Eigen::MatrixXd R = Eigen::MatrixXd::Zero(4, 4);
    for (std::size_t k = 0; k < 2; ++k) {
        TPairedMeasurement m;
        m.landmark = landmarks[k];
        m.z = sighting(mean.head<3>(), mean.segment<2>(3 + 2 * m.landmark)).z +
              residual.segment<2>(2 * k);
        m.R << 0.01 * (k + 1), 0.001, 0.001, 0.002;
        R.block<2, 2>(2 * k, 2 * k) = m.R;
        paired.push_back(m);
    }
    const Eigen::MatrixXd H = jacobian(landmarks);
    const Eigen::MatrixXd S = H * covariance * H.transpose() + R;
    const Eigen::MatrixXd K = covariance * H.transpose() * S.inverse();
    const Eigen::VectorXd expectedMean = mean + K * residual;
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(9, 9) - K * H;
    // Joseph's form: true for any gain, so it does not share the mistakes of the short one.
    const Eigen::MatrixXd joseph = left * covariance * left.transpose() + K * R * K.transpose();
    update(state(), paired);
    EXPECT_TRUE(mean.isApprox(expectedMean, 1e-10));
    EXPECT_TRUE(covariance.isApprox(joseph, 1e-10));
    EXPECT_EQ(covariance, RowMatrix(covariance.transpose()));
}

TEST_F(BlockFilter, WrapsTheInnovation) {
    mean.head<3>() << 0, 0, 0;
    mean.segment<2>(3) << -4, 0.01;  // bearing just below +pi
    const Eigen::VectorXd before = mean;
    TPairedMeasurement m;
    m.z << 4, -M_PI + 0.0025;
    m.R = Eigen::Matrix2d::Identity() * 0.01;
    update(state(), {m});
    EXPECT_LT((mean - before).norm(), 0.1);
}

TEST_F(BlockFilter, LeavesTheStateAsItIsWhereTheUpdateIsImpossible) {
    const Eigen::VectorXd before = mean;
    const RowMatrix covarianceBefore = covariance;
    TPairedMeasurement m;
    m.z << 4, 0;
    m.R = -Eigen::Matrix2d::Identity();
    EXPECT_THROW(update(state(), {m}), std::runtime_error);
    m.R = Eigen::Matrix2d::Identity();
    m.z[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(update(state(), {m}), std::runtime_error);
    EXPECT_EQ(mean, before);
    EXPECT_EQ(covariance, covarianceBefore);
}

TEST_F(BlockFilter, StartsALandmarkWithItsFullCovariance) {
    const Eigen::Vector2d z(3, -0.4);
    const Eigen::Matrix2d R = (Eigen::Matrix2d() << 0.01, 0.001, 0.001, 0.002).finished();
    const TLocated found = located(mean.head<3>(), z);
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(2, 9);
    G.leftCols<3>() = found.byPose;
    const Eigen::MatrixXd cross = G * covariance;
    const Eigen::MatrixXd own =
        cross * G.transpose() + found.byMeasurement * R * found.byMeasurement.transpose();
    mean.conservativeResize(11);
    covariance.conservativeResize(11, 11);
    initializeLast(state(), z, R);
    EXPECT_TRUE(mean.tail<2>().isApprox(found.landmark, 1e-12));
    EXPECT_TRUE(covariance.bottomLeftCorner(2, 9).isApprox(cross, 1e-12));
    EXPECT_TRUE(covariance.bottomRightCorner(2, 2).isApprox(own, 1e-12));
    EXPECT_EQ(covariance, RowMatrix(covariance.transpose()));
    EXPECT_EQ(covariance.llt().info(), Eigen::Success);
}

}  // namespace
}  // namespace salma::slam
