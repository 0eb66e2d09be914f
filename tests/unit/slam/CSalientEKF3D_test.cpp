// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/CSalientEKF3D.h>

#include <cmath>
#include <limits>
#include <random>

namespace salma::slam {
namespace {

using mrpt::math::TPoint3D;
using mrpt::poses::CPose3D;

association::TMeasurement3D seen(const CPose3D& sensor, const TPoint3D& landmark) {
    association::TMeasurement3D m;
    sensor.sphericalCoordinates(landmark, m.z[0], m.z[1], m.z[2]);
    m.R = Eigen::Vector3d(1e-4, 1e-5, 1e-5).asDiagonal();
    return m;
}

TStepInput step(double time, const CPose3D& motion) {
    TStepInput result;
    result.time = time;
    auto& spatial = result.spatial.emplace();
    spatial.increment.mean = motion;
    spatial.increment.cov.setDiagonal(6, 1e-5);
    return result;
}

const std::vector<TPoint3D> kLandmarks = {
    {4, 1, 1}, {5, -1, -1}, {3, 0.5, 0.2}, {-3, 0.1, 0.5}, {-4, -0.1, -0.7}};

/// A robot that climbs in a curve and sees everything, with noise.
TRunRecord run(const CPose3D& sensorOnRobot) {
    CSalientEKF3D filter({}, {});
    std::mt19937 random(5);
    std::normal_distribution<double> unit(0, 1);
    CPose3D robot;
    const CPose3D motion(0.1, 0, 0.02, 0.03, 0.01, 0.005);
    for (int k = 0; k < 40; ++k) {
        TStepInput input = step(k, k == 0 ? CPose3D() : motion);
        if (k > 0) robot = robot + motion;
        input.spatial->sensor = sensorOnRobot;
        for (const TPoint3D& landmark : kLandmarks) {
            auto m = seen(robot + sensorOnRobot, landmark);
            m.z += Eigen::Vector3d(0.01 * unit(random), 0.003 * unit(random), 0.003 * unit(random));
            input.spatial->measurements.push_back(m);
        }
        filter.process(input);
    }
    TRunRecord record;
    filter.results(record);
    EXPECT_NEAR((record.trajectory.back().spatial->translation() - robot.translation()).norm(), 0,
                0.03);
    return record;
}

void expectLandmarks(const TRunRecord& record) {
    ASSERT_EQ(record.landmarks.size(), kLandmarks.size());
    for (std::size_t k = 0; k < kLandmarks.size(); ++k) {  // all were seen in the first step
        EXPECT_NEAR(record.landmarks[k].mean.x, kLandmarks[k].x, 0.05);
        EXPECT_NEAR(record.landmarks[k].mean.y, kLandmarks[k].y, 0.05);
        EXPECT_NEAR(record.landmarks[k].z, kLandmarks[k].z, 0.05);
        EXPECT_GE(record.landmarks[k].sightings, 38u);  // the gate passes 99 %
    }
    EXPECT_EQ(record.associations.size(), 40 * kLandmarks.size());
    EXPECT_GE(record.innovations.size(), 3 * 37 * kLandmarks.size());
}

TEST(CSalientEKF3D, MapsLandmarksAcrossTheHalfTurn) { expectLandmarks(run(CPose3D())); }

TEST(CSalientEKF3D, TakesTheSensorsPlaceOnTheRobot) {
    expectLandmarks(run(CPose3D(0.3, 0.1, 0.5, 0.4, -0.1, 0.2)));
}

TEST(CSalientEKF3D, MovesByOdometryBeforeTheFirstLandmark) {
    CSalientEKF3D filter({}, {});
    for (int k = 0; k < 3; ++k) filter.process(step(k, CPose3D(1, 0, 0.5, 0, 0, 0)));
    EXPECT_NEAR(filter.spatialPose().mean.x(), 3, 1e-9);
    EXPECT_NEAR(filter.spatialPose().mean.z(), 1.5, 1e-9);
    EXPECT_NEAR(filter.pose().mean.x(), 3, 1e-9);
    // Three steps along, and two pitches that tilt the climb of 1 m and 0.5 m after them.
    EXPECT_NEAR(filter.spatialPose().cov(0, 0), 3e-5 + 1e-5 * (1 + 0.25), 1e-9);
}

TEST(CSalientEKF3D, LeavesOutWhatIsNotFinite) {
    CSalientEKF3D filter({}, {});
    TStepInput input = step(0, CPose3D());
    input.spatial->measurements = {seen(CPose3D(), {4, 1, 1}), seen(CPose3D(), {3, 0, 0}),
                                   seen(CPose3D(), {2, 0, 0})};
    input.spatial->measurements[1].z[2] = std::numeric_limits<double>::quiet_NaN();
    input.spatial->measurements[2].R(0, 0) = -1;
    filter.process(input);
    TRunRecord record;
    filter.results(record);
    EXPECT_EQ(record.landmarks.size(), 1u);
    EXPECT_EQ(record.associations[1].decision, EDecision::clutter);
    EXPECT_EQ(record.associations[2].decision, EDecision::clutter);
    EXPECT_TRUE(filter.internal_getPkk().asEigen().allFinite());
}

TEST(CSalientEKF3D, PairsByIdentityUnlessTheyAreIgnored) {
    for (const bool ignored : {false, true}) {
        TEkfOptions options;
        options.ignoreIdentities = ignored;
        CSalientEKF3D filter(options, {});
        for (int k = 0; k < 2; ++k) {
            TStepInput input = step(k, CPose3D());
            // The identities of two places are exchanged: only they tell.
            input.spatial->measurements = {seen(CPose3D(), {4, 0, 0}),
                                           seen(CPose3D(), {4, 0.1, 0})};
            input.spatial->measurements[0].identity = 7 + k;
            input.spatial->measurements[1].identity = 8 - k;
            filter.process(input);
        }
        TRunRecord record;
        filter.results(record);
        ASSERT_EQ(record.associations.size(), 4u);
        EXPECT_EQ(record.associations[2].landmark == record.associations[0].landmark, ignored);
    }
}

TEST(CSalientEKF3D, RefusesAStepWithoutMotionInSpaceOrWithNoNumbers) {
    CSalientEKF3D filter({}, {});
    EXPECT_THROW(filter.process(TStepInput()), std::invalid_argument);
    TStepInput input = step(0, CPose3D());
    input.spatial->increment.cov(2, 2) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(filter.process(input), std::invalid_argument);
    EXPECT_EQ(filter.spatialPose().mean.x(), 0);
}

}  // namespace
}  // namespace salma::slam
