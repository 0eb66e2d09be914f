// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/calibration/CHomography.h>

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>
#include <stdexcept>

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;
using Points = std::vector<TPoint2D>;

TPoint2D mapped(const Eigen::Matrix3d& H, const TPoint2D& p) {
    const Eigen::Vector3d q = H * Eigen::Vector3d(p.x, p.y, 1);
    return {q.x() / q.z(), q.y() / q.z()};
}

const Points kQuad{{102, 80}, {410, 130}, {395, 370}, {90, 420}};
const Points kMetres{{0, 0.6}, {0.8, 0.6}, {0.8, 0}, {0, 0}};

TEST(Homography, MapsFourPointsExactlyAndBack) {
    const auto H = CHomography::through(kQuad, kMetres),
               back = CHomography::through(kMetres, kQuad);
    ASSERT_TRUE(H && back);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(H->map(kQuad[i]).x, kMetres[i].x, 1e-12);
        EXPECT_NEAR(H->map(kQuad[i]).y, kMetres[i].y, 1e-12);
    }
    const Eigen::Matrix3d one = back->matrix() * H->matrix();
    EXPECT_LT((one / one(2, 2) - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    EXPECT_NEAR(H->matrix().norm(), 1, 1e-12);
}

TEST(Homography, AgreesWithOpenCvOnManyPoints) {
    Eigen::Matrix3d truth;
    truth << 0.9, 0.1, 20, -0.15, 0.95, 40, 2e-4, 1e-4, 1;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0, 600);
    Points from, to;
    std::vector<cv::Point2d> a, b;
    for (int i = 0; i < 20; ++i) {
        from.push_back({place(random), place(random)});
        to.push_back(mapped(truth, from.back()));
        a.emplace_back(from.back().x, from.back().y);
        b.emplace_back(to.back().x, to.back().y);
    }
    const auto H = CHomography::through(from, to);
    ASSERT_TRUE(H);
    const cv::Matx33d other = cv::findHomography(a, b, 0);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(H->matrix()(r, c) / H->matrix()(2, 2), other(r, c),
                        1e-6 * (1 + std::abs(other(r, c))));
}

TEST(Homography, IsNoWorseFarFromTheOrigin) {
    Points far = kQuad;
    for (auto& p : far) p = {p.x + 1e6, p.y - 2e6};
    const auto H = CHomography::through(far, kMetres);
    ASSERT_TRUE(H);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(H->map(far[i]).x, kMetres[i].x, 1e-6);
}

TEST(Homography, RefusesQuadsThatDetermineNone) {
    const double nan = std::nan("");
    const Points inLine{{0, 0}, {100, 0}, {200, 0}, {50, 80}};
    const Points allInLine{{0, 0}, {1, 1}, {2, 2}, {3, 3}};
    const Points onePlace{{5, 5}, {5, 5}, {5, 5}, {5, 5}};
    const Points twice{{0, 0}, {0, 0}, {100, 100}, {0, 100}};
    const Points crossed{{0, 0}, {100, 100}, {100, 0}, {0, 100}};
    const Points dented{{0, 0}, {100, 0}, {30, 20}, {0, 100}};
    const Points holed{{0, 0}, {nan, 0}, {100, 100}, {0, 100}};
    for (const Points& bad : {inLine, allInLine, onePlace, twice, crossed, dented, holed}) {
        EXPECT_FALSE(CHomography::through(bad, kMetres));
        EXPECT_FALSE(CHomography::through(kMetres, bad));
    }
    EXPECT_FALSE(CHomography::through({{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_FALSE(CHomography::through(kQuad, {{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_FALSE(CHomography::through({}, {}));
}

/// Pairs on a known map with noise of 0.3 px, of which the first `wrong` go anywhere.
struct TNoisyPairs {
    Eigen::Matrix3d truth;
    Points from, to;

    TNoisyPairs(int count, int wrong, unsigned seed) {
        truth << 0.9, 0.1, 20, -0.15, 0.95, 40, 2e-4, 1e-4, 1;
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> place(0, 600);
        std::normal_distribution<double> noise(0, 0.3);
        for (int i = 0; i < count; ++i) {
            from.push_back({place(random), place(random)});
            to.push_back(mapped(truth, from.back()));
            to.back() = i < wrong
                            ? TPoint2D(place(random), place(random))
                            : TPoint2D(to.back().x + noise(random), to.back().y + noise(random));
        }
    }
};

TEST(HomographyAmongOutliers, FindsTheMapOfHalfThePairs) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const TNoisyPairs pairs(60, 30, seed);
        const auto fit = CHomography::amongOutliers(pairs.from, pairs.to);
        ASSERT_TRUE(fit) << seed;
        ASSERT_EQ(fit->inliers.size(), 60u);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < 60; ++i) {
            EXPECT_TRUE(i < 30 || fit->inliers[i]) << seed;
            wrong += i < 30 && fit->inliers[i] ? 1 : 0;
            const TPoint2D miss =
                fit->homography.map(pairs.from[i]) - mapped(pairs.truth, pairs.from[i]);
            EXPECT_LT(std::hypot(miss.x, miss.y), 1);
        }
        EXPECT_LE(wrong, 1u);  // a random point lies within 3 px with probability 1e-4
        EXPECT_EQ(fit->count, 30 + wrong);
    }
}

TEST(HomographyAmongOutliers, SaysTheSameTwice) {
    const TNoisyPairs pairs(60, 30, 5);
    const auto once = CHomography::amongOutliers(pairs.from, pairs.to);
    const auto again = CHomography::amongOutliers(pairs.from, pairs.to);
    ASSERT_TRUE(once && again);
    EXPECT_EQ(once->homography.matrix(), again->homography.matrix());
}

TEST(HomographyAmongOutliers, RefusesPairsWithoutAMap) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const TNoisyPairs noise(20, 20, seed);
        EXPECT_FALSE(CHomography::amongOutliers(noise.from, noise.to)) << seed;
    }
    Points line, place(12, TPoint2D(3, 4));
    for (int i = 0; i < 12; ++i) line.push_back({1.0 * i, 2.0 * i});
    const TNoisyPairs good(12, 0, 1);
    for (const Points& bad : {line, place}) {
        EXPECT_FALSE(CHomography::amongOutliers(bad, bad));
        EXPECT_FALSE(CHomography::amongOutliers(bad, good.to));
        EXPECT_FALSE(CHomography::amongOutliers(good.from, bad));
    }
    Points holed = good.from;
    holed[3].x = std::nan("");
    EXPECT_FALSE(CHomography::amongOutliers(holed, good.to));
    EXPECT_FALSE(CHomography::amongOutliers({}, {}));
    EXPECT_FALSE(CHomography::amongOutliers(good.from, kQuad));
    EXPECT_FALSE(CHomography::amongOutliers(kQuad, kMetres)) << "any four pairs agree";
    THomographyOptions wrong;
    wrong.maxDistance = 0;
    EXPECT_THROW(CHomography::amongOutliers(good.from, good.to, wrong), std::invalid_argument);
}

}  // namespace
}  // namespace salma::calibration
