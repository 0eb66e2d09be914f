// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/rangeBearing.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace salma::slam {
namespace {

mrpt::obs::CObservationBearingRange record(float range, float yaw, int identity = -1) {
    mrpt::obs::CObservationBearingRange made;
    made.sensor_std_range = 0.25F;
    made.sensor_std_yaw = 0.5F;
    made.sensedData.resize(1);
    made.sensedData[0].range = range;
    made.sensedData[0].yaw = yaw;
    made.sensedData[0].pitch = 0;
    made.sensedData[0].landmarkID = identity;
    return made;
}

TEST(RangeBearing, TakesNoiseAndIdentityFromTheRecord) {
    const auto found = measurementsOf(record(2, 0.5F, 7));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].z[0], 2, 1e-9);
    EXPECT_NEAR(found[0].z[1], 0.5, 1e-9);
    EXPECT_TRUE(
        found[0].R.isApprox(Eigen::Matrix2d(Eigen::Vector2d(0.0625, 0.25).asDiagonal()), 1e-9));
    EXPECT_EQ(found[0].identity, 7);
    EXPECT_FALSE(measurementsOf(record(2, 0.5F))[0].identity);
    EXPECT_EQ(found[0].kind, association::ELandmarkKind::corner);
}

TEST(RangeBearing, TakesTheCovarianceOfEachLandmarkWhereTheRecordHasIt) {
    auto made = record(2, 0);
    made.validCovariances = true;
    made.sensedData[0].covariance.setZero();
    made.sensedData[0].covariance(0, 0) = 0.04;
    made.sensedData[0].covariance(1, 1) = 0.01;
    made.sensedData[0].covariance(0, 1) = made.sensedData[0].covariance(1, 0) = 0.005;
    const Eigen::Matrix2d expected = (Eigen::Matrix2d() << 0.04, 0.005, 0.005, 0.01).finished();
    EXPECT_TRUE(measurementsOf(made)[0].R.isApprox(expected, 1e-12));
}

TEST(RangeBearing, UsesTheOptionsWhereTheRecordStatesNoNoise) {
    auto made = record(2, 0);
    made.sensor_std_range = made.sensor_std_yaw = 0;
    TRangeBearingOptions options;
    options.sigmaRange = 0.3;
    options.sigmaBearing = 0.2;
    const auto found = measurementsOf(made, options);
    EXPECT_NEAR(found[0].R(0, 0), 0.09, 1e-12);
    EXPECT_NEAR(found[0].R(1, 1), 0.04, 1e-12);
}

TEST(RangeBearing, BringsMeasurementsIntoTheRobotFrame) {
    // The sensor stands 1 m ahead and looks to the left: 1 m from it is the point (1, 1).
    auto made = record(1, 0);
    made.sensorLocationOnRobot = mrpt::poses::CPose3D(1, 0, 0.5, M_PI / 2, 0, 0);
    const auto found = measurementsOf(made);
    EXPECT_NEAR(found[0].z[0], std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(found[0].z[1], M_PI / 4, 1e-9);
    // In the point's frame the noise is 0.25 m along y and 0.5 m along x; turned by 45 degrees:
    // range (0.0625 + 0.25) / 2, bearing the same over the squared range, covariance their half
    // difference over the range.
    EXPECT_NEAR(found[0].R(0, 0), 0.15625, 1e-9);
    EXPECT_NEAR(found[0].R(1, 1), 0.15625 / 2, 1e-9);
    EXPECT_NEAR(found[0].R(0, 1), (0.0625 - 0.25) / 2 / std::sqrt(2.0), 1e-9);
}

TEST(RangeBearing, RefusesWhatIsNotPlanarOrNotFinite) {
    auto tilted = record(2, 0);
    tilted.sensedData[0].pitch = 0.1F;
    EXPECT_THROW(measurementsOf(tilted), std::invalid_argument);
    EXPECT_THROW(measurementsOf(record(-1, 0)), std::invalid_argument);
    EXPECT_THROW(measurementsOf(record(std::numeric_limits<float>::quiet_NaN(), 0)),
                 std::invalid_argument);
    EXPECT_THROW(measurementsOf(record(1, std::numeric_limits<float>::infinity())),
                 std::invalid_argument);
}

TEST(RangeBearing, KeepsThePitchInSpace) {
    auto made = record(2, 0.5F, 7);
    made.sensedData[0].pitch = -0.25F;
    const auto found = spatialMeasurementsOf(made);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR((found[0].z - Eigen::Vector3d(2, 0.5, -0.25)).norm(), 0, 1e-7);
    EXPECT_EQ(found[0].identity, 7);
    // The record states no deviation of the pitch: that of the options.
    EXPECT_NEAR(found[0].R(2, 2), std::pow(TRangeBearingOptions().sigmaPitch, 2), 1e-12);
    EXPECT_NEAR(found[0].R(1, 1), 0.25, 1e-9);
}

TEST(RangeBearing, RefusesAPitchThatIsNoneAndOneInThePlane) {
    auto made = record(2, 0);
    for (const float pitch : {std::numeric_limits<float>::quiet_NaN(), 1.6F, -1.6F}) {
        made.sensedData[0].pitch = pitch;
        EXPECT_THROW(spatialMeasurementsOf(made), std::invalid_argument);
        EXPECT_THROW(measurementsOf(made), std::invalid_argument);
    }
}

}  // namespace
}  // namespace salma::slam
