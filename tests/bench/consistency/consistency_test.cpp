// SPDX-License-Identifier: BSD-3-Clause
#include <CConsistencyStudy.h>
#include <CFirstEstimatesFilter.h>
#include <gtest/gtest.h>
#include <salma/slam/CSalientEKF2D.h>

#include <Eigen/LU>
#include <stdexcept>

namespace salma::bench {
namespace {

TEST(ConsistencyStudy, FindsTheFilterConsistentAtLowNoise) {
    const auto result = study(CLoopWorld(2), noiseLevels()[0], 8, 100);
    EXPECT_NEAR(result.low, 1.55, 0.01);  // chi-square with 24 degrees of freedom, over 8
    EXPECT_NEAR(result.high, 4.92, 0.01);
    for (const auto& filter : result.filters) {
        EXPECT_GT(filter.meanNees, 1.5) << filter.filter;
        EXPECT_LT(filter.meanNees, 5) << filter.filter;
    }
}

TEST(ConsistencyStudy, FindsAFilterThatIsTooSure) {
    // The same drive, but the filter is told a tenth of the deviations of the measurements.
    TDrive drive = CLoopWorld(1).drive(noiseLevels()[1], 3);
    slam::CSalientEKF2D told({}, {}), sure({}, {});
    double toldNees = 0, sureNees = 0;
    const auto nees = [](const slam::CSalientEKF2D& filter, const Eigen::Vector3d& truth) {
        const auto pose = filter.pose();
        const Eigen::Vector3d error =
            Eigen::Vector3d(pose.mean.x(), pose.mean.y(), pose.mean.phi()) - truth;
        return error.head<2>().dot(
            Eigen::Matrix2d(pose.cov.asEigen().topLeftCorner<2, 2>().inverse()) * error.head<2>());
    };
    for (std::size_t k = 0; k < drive.steps.size(); ++k) {
        told.process(drive.steps[k]);
        for (auto& m : drive.steps[k].measurements) m.R *= 0.01;
        sure.process(drive.steps[k]);
        toldNees += nees(told, drive.truth[k]);
        sureNees += nees(sure, drive.truth[k]);
    }
    EXPECT_GT(sureNees, 5 * toldNees);
}

TEST(ConsistencyStudy, FindsFirstEstimatesMoreConsistentAtHighNoise) {
    const auto result = study(CLoopWorld(2), noiseLevels()[2], 6, 100);
    EXPECT_GT(result.filters[0].meanNees, 2 * result.filters[1].meanNees);
}

TEST(ConsistencyStudy, GivesTheSameForTheSameSeed) {
    const CLoopWorld world(1);
    const auto a = study(world, noiseLevels()[1], 2, 7);
    const auto b = study(world, noiseLevels()[1], 2, 7);
    EXPECT_EQ(a.filters[0].nees, b.filters[0].nees);
    EXPECT_NE(a.filters[0].nees, study(world, noiseLevels()[1], 2, 8).filters[0].nees);
    EXPECT_THROW(study(world, noiseLevels()[0], 0, 1), std::invalid_argument);
}

TEST(FirstEstimatesFilter, IsTheEkfAsLongAsNoEstimateChanges) {
    // Without noise the first estimates are the last ones too.
    const CLoopWorld world(1);
    const TNoiseLevel none{"none", 1e-9, 1e-9};
    TDrive drive = world.drive(none, 1);
    slam::CSalientEKF2D ekf({}, {});
    CFirstEstimatesFilter first;
    const TNoiseLevel stated = noiseLevels()[0];
    for (auto& step : drive.steps) {
        step.increment.cov.setDiagonal(3, stated.positionPerMetre * stated.positionPerMetre);
        for (auto& m : step.measurements) m.R = Eigen::Vector2d(0.0025, 0.0003).asDiagonal();
    }
    for (std::size_t k = 0; k < 3; ++k) {
        ekf.process(drive.steps[k]);
        first.process(drive.steps[k]);
    }
    const Eigen::Matrix3d covariance = ekf.pose().cov.asEigen();
    EXPECT_LT((first.covariance() - covariance).norm(), 0.05 * covariance.norm());
    EXPECT_NEAR(first.pose()[0], ekf.pose().mean.x(), 0.02);
}

}  // namespace
}  // namespace salma::bench
