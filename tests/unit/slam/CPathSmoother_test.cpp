// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/CPathSmoother.h>
#include <salma/slam/rangeBearingModel.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

#include "CTestWorld.h"

namespace salma::slam {
namespace {

/// A path through the test world, with the poses and places of a filter with known landmarks.
struct TExample {
    CPathHistory history;
    std::vector<int> ids;
    std::vector<Eigen::Vector2d> places;
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
};

TExample example(int steps) {
    test::CTestWorld world(3);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(3);
    RowMatrix P = RowMatrix::Zero(3, 3);
    TExample result;
    for (int k = 0; k < steps; ++k) {
        const TStepInput input = world.next();
        TPastStep step;
        step.increment << input.increment.mean.x(), input.increment.mean.y(),
            input.increment.mean.phi();
        step.Q = input.increment.cov.asEigen();
        predict({mean, P}, step.increment, step.Q);
        std::vector<TPairedMeasurement> paired;
        for (const auto& m : input.measurements) {
            step.used.push_back({*m.identity, m.z, m.R});
            const auto known = std::find(result.ids.begin(), result.ids.end(), *m.identity);
            if (known != result.ids.end())
                paired.push_back({static_cast<std::size_t>(known - result.ids.begin()), m.z, m.R});
        }
        update({mean, P}, paired);
        for (const auto& m : input.measurements) {
            if (std::count(result.ids.begin(), result.ids.end(), *m.identity) != 0) continue;
            result.ids.push_back(*m.identity);
            mean.conservativeResize(mean.size() + 2);
            P.conservativeResize(mean.size(), mean.size());
            initializeLast({mean, P}, m.z, m.R);
        }
        step.pose = mean.head<3>();
        result.history.add(step);
    }
    for (std::size_t i = 0; i < result.ids.size(); ++i)
        result.places.push_back(mean.segment<2>(3 + 2 * static_cast<Eigen::Index>(i)));
    result.mean = mean;
    result.covariance = P;
    return result;
}

TEST(CPathSmoother, AgreesWithTheFilterWhereTheProblemIsNearlyLinear) {
    const TExample e = example(12);
    const TSmoothed smoothed = CPathSmoother().smooth(e.history, e.ids, e.places);
    EXPECT_TRUE(smoothed.converged);
    EXPECT_LT((smoothed.mean - e.mean).cwiseAbs().maxCoeff(), 0.02);
    for (Eigen::Index i = 0; i < e.mean.size(); ++i)
        EXPECT_NEAR(std::sqrt(smoothed.covariance(i, i)), std::sqrt(e.covariance(i, i)),
                    0.1 * std::sqrt(e.covariance(i, i)) + 1e-4)
            << i;
    // Squared residuals of m measurements and the motions, less what was fitted.
    double measurements = 0;
    for (std::size_t k = 0; k < e.history.size(); ++k)
        measurements += 2.0 * e.history[k].used.size();
    const double freedom = measurements - 2.0 * static_cast<double>(e.ids.size());
    EXPECT_NEAR(smoothed.cost / freedom, 1, 4 * std::sqrt(2 / freedom));
}

TEST(CPathSmoother, FindsTheSameFromABentStart) {
    const TExample e = example(60);
    const TSmoothed straight = CPathSmoother().smooth(e.history, e.ids, e.places);
    TExample bent = e;
    for (std::size_t k = 0; k < bent.history.size(); ++k) {  // the heading drifts by 40 deg
        const double turn = 0.7 * static_cast<double>(k) / 60;
        Eigen::Vector3d pose = bent.history[k].pose;
        const double c = std::cos(turn), s = std::sin(turn);
        bent.history.setPose(
            k, {c * pose[0] - s * pose[1], s * pose[0] + c * pose[1], pose[2] + turn});
    }
    const TSmoothed again = CPathSmoother().smooth(bent.history, bent.ids, bent.places);
    EXPECT_TRUE(again.converged);
    EXPECT_NEAR(again.cost, straight.cost, 1e-2);
    EXPECT_LT((again.mean - straight.mean).cwiseAbs().maxCoeff(), 2e-3);
    EXPECT_GT(again.iterations, 2);
}

/// Mean squared residuals by id, after what was seen of `gone` is taken for `kept`.
std::map<int, double> misfitsOfJoined(TExample e, int gone, int kept) {
    e.history.rename(gone, kept);
    const auto at = std::find(e.ids.begin(), e.ids.end(), gone) - e.ids.begin();
    e.ids.erase(e.ids.begin() + at);
    e.places.erase(e.places.begin() + at);
    const TSmoothed smoothed = CPathSmoother().smooth(e.history, e.ids, e.places);
    std::map<int, double> result;
    for (std::size_t i = 0; i < e.ids.size(); ++i) result[e.ids[i]] = smoothed.misfit[i];
    return result;
}

/// The second half of a landmark's sightings gets a name of its own.
TExample withTornLandmark(int id, int fresh) {
    TExample e = example(40);
    const TExample whole = e;
    e.history = {};
    for (std::size_t k = 0; k < whole.history.size(); ++k) {
        TPastStep step = whole.history[k];
        for (auto& used : step.used)
            if (used.landmark == id && k >= 3) used.landmark = fresh;
        e.history.add(step);
    }
    const auto at = std::find(e.ids.begin(), e.ids.end(), id) - e.ids.begin();
    e.ids.push_back(fresh);
    e.places.push_back(e.places[static_cast<std::size_t>(at)]);
    return e;
}

TEST(CPathSmoother, TellsByTheMisfitWhetherTwoJoinedLandmarksAreOne) {
    const int kept = example(1).ids.front(), fresh = 1000;
    const auto right = misfitsOfJoined(withTornLandmark(kept, fresh), fresh, kept);
    for (const auto& [id, misfit] : right) EXPECT_LT(misfit, 3) << id << ": of 1 expected";
    const TExample e = example(40);
    const int other = *std::find_if(e.ids.begin(), e.ids.end(), [&](int id) {
        return e.history.steps().at(id).second > 10 && id != kept;
    });
    EXPECT_GT(misfitsOfJoined(e, other, kept)[kept], 4) << "what a join of maps is refused for";
}

TEST(CPathSmoother, GivesASymmetricPositiveCovariance) {
    const TExample e = example(40);
    const TSmoothed smoothed = CPathSmoother().smooth(e.history, e.ids, e.places);
    EXPECT_EQ(smoothed.covariance, RowMatrix(smoothed.covariance.transpose()));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(smoothed.covariance);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), 0);
}

TEST(CPathSmoother, RefusesWhatItCannotEstimate) {
    const CPathSmoother smoother;
    EXPECT_THROW(smoother.smooth({}, {}, {}), std::invalid_argument);
    TExample e = example(3);
    e.ids.push_back(999);
    e.places.emplace_back(0, 0);
    EXPECT_THROW(smoother.smooth(e.history, e.ids, e.places), std::invalid_argument);
    e = example(3);
    e.ids.pop_back();
    e.places.pop_back();
    EXPECT_THROW(smoother.smooth(e.history, e.ids, e.places), std::invalid_argument);
    CPathHistory bad;
    TPastStep step;
    step.Q = -Eigen::Matrix3d::Identity();
    bad.add(step);
    EXPECT_THROW(smoother.smooth(bad, {}, {}), std::runtime_error);
}

TEST(CPathHistory, KnowsWhereALandmarkWasUsed) {
    CPathHistory history;
    for (int k = 0; k < 4; ++k) {
        TPastStep step;
        step.increment << 0.5, 0, 0;
        if (k > 0) step.used.push_back({k == 3 ? 7 : 5, {1, 0}, Eigen::Matrix2d::Identity()});
        history.add(step);
    }
    EXPECT_EQ(history.back().travel, 2);
    EXPECT_EQ(history.steps().at(5), (std::pair<std::size_t, std::size_t>(1, 2)));
    history.rename(7, 5);
    EXPECT_EQ(history.steps().at(5), (std::pair<std::size_t, std::size_t>(1, 3)));
    EXPECT_EQ(history.steps().count(7), 0u);
    history.erase(5);
    EXPECT_EQ(history.steps().count(5), 0u);
}

TEST(anchorAtRobot, LeavesWhatIsPredictedAsItIs) {
    TExample e = example(30);
    RowMatrix P = e.covariance;
    const Eigen::MatrixXd before = predictionCovariance(e.mean, P);
    anchorAtRobot({e.mean, P});
    EXPECT_TRUE((P.topLeftCorner<3, 3>().isZero(0)));
    EXPECT_EQ(P, RowMatrix(P.transpose()));
    EXPECT_TRUE(predictionCovariance(e.mean, P).isApprox(before, 1e-9));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(P);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-12);
}

TEST(carried, MovesAnErrorOfTheBaseToThePose) {
    Eigen::Matrix3d covariance;
    covariance << 0.04, 0.01, 0, 0.01, 0.09, 0.002, 0, 0.002, 0.01;
    const Eigen::Vector3d base(1, 2, 0.3), motion(3, -1, 0.5);
    const Eigen::Vector3d pose = moved(base, motion).pose;
    Eigen::Matrix3d J;
    for (int i = 0; i < 3; ++i) {
        Eigen::Vector3d more = base, less = base;
        more[i] += 1e-5;
        less[i] -= 1e-5;
        J.col(i) = (moved(more, motion).pose - moved(less, motion).pose) / 2e-5;
    }
    EXPECT_TRUE(carried(covariance, base, pose).isApprox(J * covariance * J.transpose(), 1e-7));
}

}  // namespace
}  // namespace salma::slam
