// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/rangeBearingModel.h>

#include <cmath>
#include <functional>
#include <random>

namespace salma::slam {
namespace {

using Function = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Derivative by central differences; `angleRow` of the result is an angle.
Eigen::MatrixXd numeric(const Function& f, const Eigen::VectorXd& x, Eigen::Index angleRow) {
    const double step = 1e-6;
    Eigen::MatrixXd result(f(x).size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        Eigen::VectorXd ahead = x;
        Eigen::VectorXd behind = x;
        ahead[k] += step;
        behind[k] -= step;
        Eigen::VectorXd difference = f(ahead) - f(behind);
        if (angleRow >= 0) difference[angleRow] = mrpt::math::wrapToPi(difference[angleRow]);
        result.col(k) = difference / (2 * step);
    }
    return result;
}

class RangeBearingModel : public ::testing::Test {
 protected:
    Eigen::Vector3d randomPose() {
        return {m_place(m_random), m_place(m_random), m_turn(m_random)};
    }
    Eigen::Vector2d randomPoint() { return {m_place(m_random), m_place(m_random)}; }

    std::mt19937 m_random{4};
    std::uniform_real_distribution<double> m_place{-5, 5};
    std::uniform_real_distribution<double> m_turn{-M_PI, M_PI};
};

TEST_F(RangeBearingModel, MovesInTheRobotsFrame) {
    // Facing +y, 1 m ahead and 2 m to the left, a quarter turn to the right.
    const TMotion motion = moved({1, 1, M_PI / 2}, {1, 2, -M_PI / 2});
    EXPECT_TRUE(motion.pose.isApprox(Eigen::Vector3d(-1, 2, 0), 1e-12));
}

TEST_F(RangeBearingModel, SeesALandmarkToTheLeft) {
    const TSighting seen = sighting({1, 1, M_PI}, {1, -2});
    EXPECT_TRUE(seen.z.isApprox(Eigen::Vector2d(3, M_PI / 2), 1e-12));
}

TEST_F(RangeBearingModel, HasTheDerivativesOfAMotion) {
    for (int trial = 0; trial < 20; ++trial) {
        const Eigen::Vector3d pose = randomPose();
        const Eigen::Vector3d increment = randomPose();
        const TMotion motion = moved(pose, increment);
        const auto byPose = [&](const Eigen::VectorXd& x) { return moved(x, increment).pose; };
        const auto byIncrement = [&](const Eigen::VectorXd& u) { return moved(pose, u).pose; };
        EXPECT_TRUE(motion.byPose.isApprox(numeric(byPose, pose, 2), 1e-7));
        EXPECT_TRUE(motion.byIncrement.isApprox(numeric(byIncrement, increment, 2), 1e-7));
    }
}

TEST_F(RangeBearingModel, HasTheDerivativesOfASighting) {
    for (int trial = 0; trial < 20; ++trial) {
        const Eigen::Vector3d pose = randomPose();
        const Eigen::Vector2d landmark = randomPoint();
        const TSighting seen = sighting(pose, landmark);
        const auto byPose = [&](const Eigen::VectorXd& x) { return sighting(x, landmark).z; };
        const auto byLandmark = [&](const Eigen::VectorXd& y) { return sighting(pose, y).z; };
        EXPECT_TRUE(seen.byPose.isApprox(numeric(byPose, pose, 1), 1e-6));
        EXPECT_TRUE(seen.byLandmark.isApprox(numeric(byLandmark, landmark, 1), 1e-6));
    }
}

TEST_F(RangeBearingModel, HasFiniteDerivativesAtRightAnglesAndAtTheRobotItself) {
    const TSighting beside = sighting({0, 0, 0}, {0, 2});
    EXPECT_TRUE(beside.byPose.isApprox((Matrix23() << 0, -1, 0, 0.5, 0, -1).finished(), 1e-12));
    EXPECT_TRUE(sighting({1, 1, 0}, {1, 1}).byPose.allFinite());
    EXPECT_TRUE(sighting({1, 1, 0}, {1, 1}).byLandmark.allFinite());
}

TEST_F(RangeBearingModel, LocatesWhatItSees) {
    for (int trial = 0; trial < 20; ++trial) {
        const Eigen::Vector3d pose = randomPose();
        const Eigen::Vector2d landmark = randomPoint();
        const Eigen::Vector2d z = sighting(pose, landmark).z;
        const TLocated found = located(pose, z);
        EXPECT_TRUE(found.landmark.isApprox(landmark, 1e-9));
        const auto byPose = [&](const Eigen::VectorXd& x) { return located(x, z).landmark; };
        const auto byZ = [&](const Eigen::VectorXd& m) { return located(pose, m).landmark; };
        EXPECT_TRUE(found.byPose.isApprox(numeric(byPose, pose, -1), 1e-6));
        EXPECT_TRUE(found.byMeasurement.isApprox(numeric(byZ, z, -1), 1e-6));
    }
}

}  // namespace
}  // namespace salma::slam
