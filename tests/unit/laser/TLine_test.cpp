// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/laser/TLine.h>

#include <cmath>

namespace salma::laser {
namespace {

TLine wallAhead() {
    TLine line;
    line.rho = 2;
    line.alpha = 0;
    line.from = {2, -1};
    line.to = {2, 3};
    line.covariance << 1e-4, 2e-5, 2e-5, 4e-4;
    return line;
}

TEST(TLine, MovesIntoAFrameThatLooksAtItFromTheSide) {
    // the robot stands at (1, 1) and looks along +y: what is ahead of it (x) is world y
    const TLine w = transformed(wallAhead(), mrpt::poses::CPose2D(1, 1, M_PI / 2));
    EXPECT_NEAR(w.rho, 3, 1e-12);  // world line y = 1 + 2
    EXPECT_NEAR(w.alpha, M_PI / 2, 1e-12);
    EXPECT_NEAR(w.from.x, 2, 1e-12);
    EXPECT_NEAR(w.from.y, 3, 1e-12);
    EXPECT_NEAR(w.length(), 4, 1e-12);
}

TEST(TLine, KeepsRhoPositiveWhenTheOriginChangesSides) {
    const TLine w = transformed(wallAhead(), mrpt::poses::CPose2D(-5, 0, 0));
    EXPECT_NEAR(w.rho, 3, 1e-12);
    EXPECT_NEAR(std::abs(w.alpha), M_PI, 1e-12);
}

TEST(TLine, PropagatesItsCovarianceAsCentralDifferencesDo) {
    for (const double x : {0.5, -5.0}) {  // without and with a change of sides
        const mrpt::poses::CPose2D T(x, 0.7, 0.4);
        Eigen::Matrix2d J;
        const double h = 1e-6;
        for (int i = 0; i < 2; ++i) {
            TLine up = wallAhead();
            TLine down = wallAhead();
            (i == 0 ? up.rho : up.alpha) += h;
            (i == 0 ? down.rho : down.alpha) -= h;
            const TLine a = transformed(up, T);
            const TLine b = transformed(down, T);
            J(0, i) = (a.rho - b.rho) / (2 * h);
            J(1, i) = mrpt::math::wrapToPi(a.alpha - b.alpha) / (2 * h);
        }
        const Eigen::Matrix2d expected = J * wallAhead().covariance * J.transpose();
        EXPECT_LT((transformed(wallAhead(), T).covariance - expected).norm(), 1e-9) << "x = " << x;
    }
}

}  // namespace
}  // namespace salma::laser
