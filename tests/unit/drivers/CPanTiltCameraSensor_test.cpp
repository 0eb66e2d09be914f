// SPDX-License-Identifier: BSD-3-Clause
#include <messages.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationImage.h>
#include <salma/config/CStrictFile.h>
#include <salma/drivers/CPanTiltCameraSensor.h>
#include <salma/drivers/CSerialLine.h>
#include <salma/drivers/registerSensors.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "cameraOnAPort.h"

using namespace salma;
using drivers::CPanTiltCameraSensor;
using mrpt::DEG2RAD;
using mrpt::RAD2DEG;
using observations::CObservationPanTilt;

namespace {

using salma::test::contains;
using salma::test::messageOf;

class PanTiltSensor : public test::CameraOnAPort {
 protected:
    void load(const std::string& more = "") {
        m_sensor.setMinLoggingLevel(mrpt::system::LVL_ERROR);
        m_sensor.loadConfig(
            mrpt::config::CConfigFileMemory(
                "[HEAD]\ndriver = CPanTiltCameraSensor\nprocess_rate = 10\nsensorLabel = HEAD_1\n"
                "port = " +
                port() + "\nreply_timeout_s = 0.25\nretries = 1\nreconnect_s = 0.01\n" + more),
            "HEAD");
    }

    std::vector<CObservationPanTilt::Ptr> take() {
        std::vector<CObservationPanTilt::Ptr> states;
        for (const auto& entry : m_sensor.getObservations())
            states.push_back(std::dynamic_pointer_cast<CObservationPanTilt>(entry.second));
        return states;
    }

    /// Lets the sensor work until it has a record again; false if none comes in half a minute.
    bool recovers() {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (std::chrono::steady_clock::now() < end) {
            m_sensor.doProcess();
            if (!take().empty()) return true;
            std::this_thread::yield();
        }
        return false;
    }

    CPanTiltCameraSensor m_sensor;
};

}  // namespace

TEST_F(PanTiltSensor, RecordsWhereTheHeadStands) {
    {
        drivers::CViscaCamera camera(port());
        camera.moveTo(DEG2RAD(10.0), DEG2RAD(5.0));
        camera.setZoom(1.2);
        camera.wait();
    }
    load("base_x_m = 0.3\nbase_z_m = 1\ncamera_x_m = 0.05\n");
    m_sensor.initialize();
    EXPECT_EQ(m_sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssWorking);
    m_sensor.doProcess();
    m_sensor.doProcess();
    const auto states = take();
    ASSERT_EQ(states.size(), 2U);
    EXPECT_EQ(states[0]->sensorLabel, "HEAD_1");
    EXPECT_NEAR(RAD2DEG(states[0]->pan), 10, 1e-9);
    EXPECT_NEAR(RAD2DEG(states[0]->tilt), 5, 1e-9);
    EXPECT_NEAR(states[0]->zoom, 1.2, 0.005);
    EXPECT_EQ(states[1]->zoom, states[0]->zoom);
    EXPECT_LT(states[0]->timestamp, states[1]->timestamp);
    // The optical axis (z) of the camera looks where the head points: 10 deg left, 5 deg up.
    const auto camera = states[0]->cameraPose();
    const auto ahead = camera.composePoint({0, 0, 1}) - camera.translation();
    EXPECT_NEAR(RAD2DEG(std::atan2(ahead.y, ahead.x)), 10, 1e-9);
    EXPECT_NEAR(RAD2DEG(std::asin(ahead.z)), 5, 1e-9);
    EXPECT_NEAR(camera.z(), 1 + 0.05 * std::sin(DEG2RAD(5.0)), 1e-9);
}

TEST_F(PanTiltSensor, GivesPicturesThePoseOfTheirOwnStamp) {
    load();
    m_sensor.initialize();
    m_sensor.doProcess();
    m_sensor.doProcess();
    const auto states = take();
    ASSERT_EQ(states.size(), 2U);
    mrpt::obs::CObservationImage picture;
    picture.timestamp = states[0]->timestamp;
    ASSERT_TRUE(m_sensor.stamp(picture, 0));
    EXPECT_LT(mrpt::poses::CPose3D(picture.cameraPose).distanceTo(states[0]->cameraPose()), 1e-9);
    EXPECT_NEAR(RAD2DEG(picture.cameraPose.yaw()), -90, 1e-9);
    picture.timestamp = states[0]->timestamp - std::chrono::seconds(1);
    picture.cameraPose = {};
    EXPECT_FALSE(m_sensor.stamp(picture, 0.5));
    EXPECT_EQ(picture.cameraPose.yaw(), 0);
    EXPECT_TRUE(m_sensor.stamp(picture, 2));
}

TEST_F(PanTiltSensor, TurnsWhereItIsToldToWhileItMakesRecords) {
    load();
    m_sensor.initialize();
    EXPECT_THROW(m_sensor.pointTo(DEG2RAD(101.0), 0, 1), std::invalid_argument);
    EXPECT_THROW(m_sensor.pointTo(0, DEG2RAD(-26.0), 1), std::invalid_argument);
    EXPECT_THROW(m_sensor.pointTo(0, 0, 0), std::invalid_argument);
    EXPECT_THROW(m_sensor.pointTo(std::nan(""), 0, 1), std::invalid_argument);
    m_sensor.pointTo(DEG2RAD(-40.0), 0, 1);  // forgotten for the next
    m_sensor.pointTo(DEG2RAD(12.0), DEG2RAD(6.0), DEG2RAD(80.0));
    CObservationPanTilt::Ptr last;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end) {
        m_sensor.doProcess();
        for (const auto& state : take()) last = state;
        ASSERT_TRUE(last);
        EXPECT_GT(RAD2DEG(last->pan), -0.1);
        if (RAD2DEG(last->pan) > 11.95 && RAD2DEG(last->tilt) > 5.95) break;
    }
    EXPECT_NEAR(RAD2DEG(last->pan), 12, 0.1);
    EXPECT_NEAR(RAD2DEG(last->tilt), 6, 0.1);
    EXPECT_EQ(motions(), 1);
}

TEST_F(PanTiltSensor, GoesOnWithItsRecordsWhenTheCameraRefusesToTurn) {
    load();
    m_sensor.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    m_sensor.initialize();
    m_sensor.pointTo(DEG2RAD(12.0), 0, 1);
    misbehave({test::EFault::notExecutable});
    m_sensor.doProcess();
    EXPECT_EQ(take().size(), 1U);
    EXPECT_EQ(m_sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssWorking);
    EXPECT_NEAR(truePan(), 0, 1e-9);
}

TEST_F(PanTiltSensor, IsKnownToMrptByItsName) {
    drivers::registerSensors();
    const auto sensor = mrpt::hwdrivers::CGenericSensor::createSensorPtr("CPanTiltCameraSensor");
    EXPECT_TRUE(std::dynamic_pointer_cast<CPanTiltCameraSensor>(sensor));
}

TEST_F(PanTiltSensor, ItsSectionIsReadStrictly) {
    EXPECT_TRUE(contains(messageOf([&] { load("zoom_evry = 3\n"); }), "unknown keys: zoom_evry"));
    EXPECT_TRUE(contains(messageOf([&] { load("zoom_every = 0\n"); }), "(HEAD) zoom_every = '0'"));
    EXPECT_TRUE(contains(messageOf([&] { load("base_x_m = much\n"); }), "is not a number"));
    EXPECT_TRUE(contains(messageOf([&] { load("tilt_min_deg = 80\n"); }), "tilt_min_deg"));
}

TEST_F(PanTiltSensor, TheSectionThatItPrintsCanBeRead) {
    const drivers::TPanTiltCameraOptions options;
    drivers::TPanTiltCameraOptions loaded;
    loaded.base.x = 5;
    loaded.loadFromConfigFile(mrpt::config::CConfigFileMemory(options.asIni("HEAD")), "HEAD");
    EXPECT_EQ(loaded.asIni("HEAD"), options.asIni("HEAD"));
}

TEST_F(PanTiltSensor, TheShippedSectionCanBeRead) {
    const auto file = config::openStrict(SALMA_SOURCE_DIR "/share/grabber/evi-d30.ini");
    drivers::TPanTiltCameraOptions options;
    EXPECT_NO_THROW(options.loadFromConfigFile(*file, "HEAD"));
    EXPECT_EQ(options.port, "/dev/ttyS0");
    EXPECT_EQ(options.base.z, 0.6);
}

TEST_F(PanTiltSensor, APortThatIsMissingOrSilentAtTheStartIsAnError) {
    load();
    m_emulator.locked([&] { m_device.sleep(true); });
    EXPECT_TRUE(contains(messageOf([&] { m_sensor.initialize(); }), "no answer"));
    m_emulator.unplug();
    EXPECT_TRUE(contains(messageOf([&] { m_sensor.initialize(); }), "no such serial port"));
}

TEST_F(PanTiltSensor, APortInUseIsAnErrorAtTheStart) {
    load();
    const drivers::CSerialLine other(port(), 9600);
    EXPECT_TRUE(contains(messageOf([&] { m_sensor.initialize(); }), "in use by another program"));
}

TEST_F(PanTiltSensor, ALostCameraIsLookedForAndFoundAgain) {
    load();
    m_sensor.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    m_sensor.initialize();
    m_sensor.doProcess();
    EXPECT_EQ(take().size(), 1U);
    m_emulator.unplug();
    for (int i = 0; i < 5; ++i) EXPECT_NO_THROW(m_sensor.doProcess());
    EXPECT_TRUE(take().empty());
    EXPECT_EQ(m_sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssError);
    m_emulator.locked([&] { m_device.sleep(false); });  // it lost its power as well
    m_emulator.plug();
    EXPECT_TRUE(recovers());
    EXPECT_EQ(m_sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssWorking);
    m_emulator.locked([&] { m_device.sleep(true); });
    EXPECT_NO_THROW(m_sensor.doProcess());
    EXPECT_TRUE(take().empty());
    m_emulator.locked([&] { m_device.sleep(false); });
    EXPECT_TRUE(recovers());
}

TEST_F(PanTiltSensor, AClockThatJumpsBackStartsTheHistoryAnew) {
    load();
    m_sensor.initialize();
    const auto at = [](double time) { return mrpt::Clock::fromDouble(time); };
    mrpt::Clock::setActiveClock(mrpt::Clock::Simulated);
    for (const double time : {1000.0, 1001.0, 500.0, 501.0}) {
        mrpt::Clock::setSimulatedTime(at(time));
        EXPECT_NO_THROW(m_sensor.doProcess());
    }
    mrpt::Clock::setActiveClock(mrpt::Clock::Realtime);
    EXPECT_EQ(take().size(), 4U);
    EXPECT_TRUE(m_sensor.cameraPose(at(500.5), 0));
    EXPECT_FALSE(m_sensor.cameraPose(at(1000.5), 1));
}

TEST_F(PanTiltSensor, RemembersTenSeconds) {
    load();
    m_sensor.initialize();
    const auto at = [](double time) { return mrpt::Clock::fromDouble(time); };
    mrpt::Clock::setActiveClock(mrpt::Clock::Simulated);
    for (int time = 1000; time <= 1030; ++time) {
        mrpt::Clock::setSimulatedTime(at(time));
        m_sensor.doProcess();
    }
    mrpt::Clock::setActiveClock(mrpt::Clock::Realtime);
    EXPECT_TRUE(m_sensor.cameraPose(at(1020.5), 0));
    EXPECT_FALSE(m_sensor.cameraPose(at(1018.5), 0));
}
