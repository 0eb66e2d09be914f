// SPDX-License-Identifier: BSD-3-Clause
#include <messages.h>
#include <mrpt/core/bits_math.h>

#include <cmath>
#include <limits>
#include <utility>

#include "cameraOnAPort.h"

using namespace salma;
using drivers::CViscaCamera;
using drivers::CViscaError;
using mrpt::DEG2RAD;
using mrpt::RAD2DEG;

namespace {

using salma::test::messageOf;

using ViscaCamera = test::CameraOnAPort;

}  // namespace

TEST_F(ViscaCamera, TurnsToWhereItIsSent) {
    CViscaCamera camera(port());
    camera.moveTo(DEG2RAD(20.0), DEG2RAD(-5.0));
    camera.wait();
    EXPECT_NEAR(truePan(), 176, 1e-9);   // 20 * 8.8
    EXPECT_NEAR(trueTilt(), -60, 1e-9);  // -5 * 12
    const auto state = camera.panTilt();
    EXPECT_NEAR(RAD2DEG(state.pan), 20, 1e-9);
    EXPECT_NEAR(RAD2DEG(state.tilt), -5, 1e-9);
}

TEST_F(ViscaCamera, ReportsPositionsOnTheWayWithTimesThatFitTheMotion) {
    CViscaCamera camera(port());
    const double speed = DEG2RAD(30.0);
    camera.moveTo(DEG2RAD(15.0), 0, speed);
    int onTheWay = 0;
    for (int i = 0; i < 20; ++i) {
        const auto state = camera.panTilt();
        double truth = 0;
        m_emulator.locked([&] { truth = m_device.pan().at(state.time); });
        ASSERT_GE(state.uncertainty, 0);
        // The head stood there at most `uncertainty` before or after, and positions are whole
        // counts.
        const double slack = RAD2DEG(speed * state.uncertainty) * 8.8 + 0.5 + 1e-3;
        EXPECT_NEAR(RAD2DEG(state.pan) * 8.8, truth, slack);
        if (state.pan > 0 && state.pan < DEG2RAD(15.0)) ++onTheWay;
    }
    EXPECT_GT(onTheWay, 0);
    camera.wait();
}

TEST_F(ViscaCamera, MovesByADifference) {
    CViscaCamera camera(port());
    camera.moveTo(DEG2RAD(-10.0), DEG2RAD(10.0));
    camera.wait();
    camera.moveBy(DEG2RAD(5.0), DEG2RAD(-2.0));
    camera.wait();
    EXPECT_NEAR(truePan(), -44, 1);
    EXPECT_NEAR(trueTilt(), 96, 1);
}

TEST_F(ViscaCamera, RoundsTheSpeedToTheStepsOfTheCamera) {
    CViscaCamera camera(port());
    const auto speeds = [&](double degrees) {
        camera.moveTo(DEG2RAD(1.0), DEG2RAD(1.0), DEG2RAD(degrees));
        std::pair<double, double> counts;
        m_emulator.locked([&] { counts = {m_device.pan().speed(), m_device.tilt().speed()}; });
        return std::make_pair(counts.first / 8.8, counts.second / 12);
    };
    const auto expectNear = [](std::pair<double, double> speed, double pan, double tilt) {
        EXPECT_NEAR(speed.first, pan, 1e-9);
        EXPECT_NEAR(speed.second, tilt, 1e-9);
    };
    expectNear(speeds(30), 30, 30);           // 9 steps of 3.33, 12 of 2.5
    expectNear(speeds(0.1), 80.0 / 24, 2.5);  // the slowest
    expectNear(speeds(80), 80, 50);           // the fastest of each axis
    expectNear(speeds(11), 10, 10);
    camera.wait();
}

TEST_F(ViscaCamera, GoesHome) {
    CViscaCamera camera(port());
    camera.moveTo(DEG2RAD(12.0), DEG2RAD(3.0));
    camera.wait();
    camera.home();
    camera.wait();
    EXPECT_EQ(truePan(), 0);
    EXPECT_EQ(trueTilt(), 0);
}

TEST_F(ViscaCamera, ZoomsByFocalLength) {
    CViscaCamera camera(port());
    EXPECT_NEAR(camera.zoom(), 1, 1e-12);
    camera.setZoom(1.5);
    camera.wait();
    EXPECT_NEAR(camera.zoom(), 1.5, 0.005);
    double counts = 0;
    m_emulator.locked([&] { counts = m_device.zoom().at(test::CEmulator::now()); });
    EXPECT_NEAR(counts, 1023 * std::log(1.5) / std::log(11.81), 1);
}

TEST_F(ViscaCamera, HeadAndLensMoveAtOnceInTwoSockets) {
    CViscaCamera camera(port());
    camera.moveTo(DEG2RAD(20.0), 0, DEG2RAD(40.0));
    camera.setZoom(2);
    camera.wait();
    EXPECT_NEAR(truePan(), 176, 1e-9);
    EXPECT_NEAR(camera.zoom(), 2, 0.005);
    EXPECT_EQ(motions(), 2);
}

TEST_F(ViscaCamera, ALaterMoveReplacesAnEarlierOne) {
    CViscaCamera camera(port());
    camera.moveTo(DEG2RAD(90.0), 0, DEG2RAD(20.0));
    camera.moveTo(DEG2RAD(-5.0), 0);
    camera.wait();
    EXPECT_NEAR(truePan(), -44, 1e-9);
}

TEST_F(ViscaCamera, StopsOnTheWay) {
    CViscaCamera camera(port());
    camera.moveTo(DEG2RAD(90.0), 0, DEG2RAD(10.0));
    camera.stop();
    const double pan = truePan();
    EXPECT_LT(pan, 790);
    EXPECT_NO_THROW(camera.wait());
    EXPECT_EQ(truePan(), pan);
}

TEST_F(ViscaCamera, KeepsItsLimitsAndSendsNothingBeyond) {
    CViscaCamera camera(port());
    EXPECT_EQ(messageOf([&] { camera.moveTo(DEG2RAD(101.0), 0); }),
              "pan 101 deg is outside [-100, 100] deg");
    EXPECT_EQ(messageOf([&] { camera.moveTo(0, DEG2RAD(-25.5)); }),
              "tilt -25.5 deg is outside [-25, 25] deg");
    EXPECT_EQ(messageOf([&] { camera.moveBy(DEG2RAD(-100.2), 0); }),
              "pan -100.2 deg is outside [-100, 100] deg");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(camera.moveTo(nan, 0), std::invalid_argument);
    EXPECT_THROW(camera.moveTo(0, nan), std::invalid_argument);
    EXPECT_THROW(camera.moveTo(0, 0, nan), std::invalid_argument);
    EXPECT_THROW(camera.moveTo(0, 0, 0), std::invalid_argument);
    EXPECT_THROW(camera.moveTo(0, 0, DEG2RAD(81.0)), std::invalid_argument);
    EXPECT_THROW(camera.setZoom(0.9), std::invalid_argument);
    EXPECT_THROW(camera.setZoom(12), std::invalid_argument);
    EXPECT_THROW(camera.setZoom(nan), std::invalid_argument);
    EXPECT_EQ(motions(), 0);
    camera.moveTo(DEG2RAD(4.0), DEG2RAD(25.0));  // an end itself can be reached
    camera.wait();
    EXPECT_NEAR(trueTilt(), 300, 1e-9);
}

TEST_F(ViscaCamera, CountsAndTheirSignAreOptions) {
    auto options = quick();
    options.panCounts = -8.61;
    options.tiltCounts = 11.44;
    CViscaCamera camera(port(), options);
    camera.moveTo(DEG2RAD(10.0), DEG2RAD(5.0));
    camera.wait();
    EXPECT_NEAR(truePan(), -86, 1e-9);
    EXPECT_NEAR(trueTilt(), 57, 1e-9);
    EXPECT_NEAR(RAD2DEG(camera.panTilt().pan), 10, 0.06);
}

TEST_F(ViscaCamera, FieldOfViewFollowsTheZoom) {
    CViscaCamera camera(port());
    EXPECT_NEAR(RAD2DEG(camera.fieldOfView(1)), 48.8, 1e-9);
    EXPECT_NEAR(RAD2DEG(camera.fieldOfView(2)), RAD2DEG(2 * std::atan(std::tan(DEG2RAD(24.4)) / 2)),
                1e-9);
}

TEST_F(ViscaCamera, BadOptionsAreRefusedBeforeThePortIsTouched) {
    auto options = quick();
    options.address = 0;
    EXPECT_THROW(CViscaCamera("/no/such/port", options), std::invalid_argument);
}
