// SPDX-License-Identifier: BSD-3-Clause
// What the searches calculate with, against Eigen's own.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "CWhitener.h"
#include "informationBlocks.h"

namespace salma::association {
namespace {

/// Symmetric and positive definite.
Eigen::MatrixXd covariance(Eigen::Index size) {
    const Eigen::MatrixXd root = Eigen::MatrixXd::Random(size, size);
    return root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
}

template <int DIM>
void expectWhitens() {
    for (int trial = 0; trial < 100; ++trial) {
        const TReadingCovariance<DIM> C = covariance(DIM);
        CWhitener<DIM> whitener;
        ASSERT_TRUE(whitener.set(C));
        EXPECT_NEAR(whitener.rootOfDeterminant(), std::sqrt(C.determinant()), 1e-9);
        EXPECT_TRUE(whitener.ofCovariance(C).isIdentity(1e-9));
        const TReading<DIM> value = TReading<DIM>::Random();
        EXPECT_NEAR((whitener * value).squaredNorm(), value.dot(C.inverse() * value), 1e-8);
    }
}

TEST(CWhitener, TakesVectorsToUnitCovariance) {
    expectWhitens<2>();
    expectWhitens<3>();
}

TEST(CWhitener, RefusesWhatIsNotPositiveDefinite) {
    CWhitener<2> whitener;
    EXPECT_FALSE(whitener.set(Eigen::Vector2d(1, 0).asDiagonal()));
    EXPECT_FALSE(whitener.set(Eigen::Vector2d(1, -1).asDiagonal()));
    Eigen::Matrix2d beyond;
    beyond << 1, 2, 2, 1;
    EXPECT_FALSE(whitener.set(beyond));
    EXPECT_FALSE(
        whitener.set(Eigen::Vector2d(1, std::numeric_limits<double>::quiet_NaN()).asDiagonal()));
}

template <int DIM>
void expectBlocks(Eigen::Index landmarks) {
    const Eigen::MatrixXd C = covariance(DIM * landmarks);
    const Eigen::MatrixXd expected = C.inverse();
    const auto blocks = informationBlocks<DIM>(Eigen::LLT<Eigen::MatrixXd>(C));
    ASSERT_EQ(blocks.size(), static_cast<std::size_t>(landmarks));
    for (Eigen::Index k = 0; k < landmarks; ++k) {
        const TReadingCovariance<DIM> block = expected.block<DIM, DIM>(DIM * k, DIM * k);
        EXPECT_TRUE(blocks[static_cast<std::size_t>(k)].isApprox(block, 1e-8)) << k;
    }
}

TEST(InformationBlocks, AreThoseOfTheWholeInverse) {
    for (const Eigen::Index landmarks : {0, 1, 15, 16, 17, 50}) {
        expectBlocks<2>(landmarks);
        expectBlocks<3>(landmarks);
    }
}

}  // namespace
}  // namespace salma::association
