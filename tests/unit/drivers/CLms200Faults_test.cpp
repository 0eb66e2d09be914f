// SPDX-License-Identifier: BSD-3-Clause
// What goes wrong on the line between computer and laser.
#include <mrpt/core/Clock.h>

#include "laserOnAPort.h"

using namespace salma;
using drivers::CLms200;
using test::contains;
using test::ELmsFault;
using test::messageOf;

namespace {

class LaserFaults : public test::LaserOnAPort {
 protected:
    void start(const std::string& more = "") {
        load(m_sensor, "COM_baudRate = 500000\nresolution = 100\nsilence_s = 0.5\n" + more);
        m_sensor.initialize();
        ASSERT_GE(take(m_sensor, 1).size(), 1U);
    }

    CLms200 m_sensor;
};

class LaserCommandFaults : public LaserFaults, public testing::WithParamInterface<ELmsFault> {};

}  // namespace

/// Each second command meets the fault until it was met four times.
TEST_P(LaserCommandFaults, AreGotOverWhileTheLaserIsSetUp) {
    const ELmsFault fault = GetParam();
    load(m_sensor, "COM_baudRate = 500000\n");
    m_emulator.locked([&] {
        m_device.misbehave({ELmsFault::none, fault, ELmsFault::none, fault, ELmsFault::none, fault,
                            ELmsFault::none, fault});
    });
    // MRPT repeats most commands; what it does not repeat, as the change of the rate, costs an
    // attempt, after which the grabber would end or reconnect.
    int attempts = 1;
    while (!messageOf([&] { m_sensor.initialize(); }).empty() && attempts < 6) ++attempts;
    EXPECT_LE(attempts, 4);
    const auto scans = take(m_sensor, 2);
    ASSERT_GE(scans.size(), 2U);
    expectTheWall(*scans[1], 0.00501);
}

INSTANTIATE_TEST_SUITE_P(All,
                         LaserCommandFaults,
                         testing::Values(ELmsFault::deaf,
                                         ELmsFault::noAcknowledge,
                                         ELmsFault::noAnswer,
                                         ELmsFault::refusal,
                                         ELmsFault::wrongChecksum,
                                         ELmsFault::cutTelegram,
                                         ELmsFault::noise,
                                         ELmsFault::absurdLength));

/// A scan whose telegram is spoilt is lost; the others are not, and none is wrong.
TEST_F(LaserFaults, ASpoiltScanCostsThatScanOnly) {
    start();
    const std::size_t badBefore = m_sensor.counts().badTelegrams;
    std::deque<ELmsFault> faults;
    for (int i = 0; i < 5; ++i)
        for (const auto fault : {ELmsFault::wrongChecksum, ELmsFault::none, ELmsFault::cutTelegram,
                                 ELmsFault::none, ELmsFault::noise, ELmsFault::absurdLength})
            faults.push_back(fault);
    int before = 0;
    m_emulator.locked([&] {
        m_device.spoilScans(faults);
        before = m_device.scans();
    });
    // 20 of the 30 come through; the emulator's queue is empty when a 21st has come.
    const auto scans = take(m_sensor, 25);
    ASSERT_GE(scans.size(), 25U);
    for (const auto& scan : scans) expectTheWall(*scan, 0.00501);
    EXPECT_GE(m_sensor.counts().badTelegrams, badBefore + 15);  // two bad headers in five of them
    EXPECT_EQ(m_sensor.counts().reconnections, 0U);
    m_emulator.locked([&] { EXPECT_GE(m_device.scans() - before, 30); });
}

TEST_F(LaserFaults, ALaserThatFallsSilentIsLostAndFoundAgain) {
    start();
    m_emulator.locked([&] { m_device.silence(true); });
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (m_sensor.getState() != mrpt::hwdrivers::CGenericSensor::ssError &&
           std::chrono::steady_clock::now() < end)
        EXPECT_NO_THROW(m_sensor.doProcess());
    EXPECT_EQ(m_sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssError);
    m_sensor.getObservations();  // from before
    m_emulator.locked([&] { m_device.silence(false); });
    EXPECT_GE(take(m_sensor, 3).size(), 3U);
    EXPECT_EQ(m_sensor.counts().reconnections, 1U);
    EXPECT_EQ(m_sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssWorking);
}

TEST_F(LaserFaults, ACableThatComesOffAndALaserThatLosesItsPowerAreSurvived) {
    start("FOV = 100\n");
    m_emulator.unplug();
    for (int i = 0; i < 5; ++i) EXPECT_NO_THROW(m_sensor.doProcess());
    EXPECT_EQ(m_sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssError);
    m_sensor.getObservations();
    m_emulator.locked([&] { m_device.sleep(false); });  // back at 9600 baud, nothing set
    m_emulator.plug();
    const auto scans = take(m_sensor, 2);
    ASSERT_GE(scans.size(), 2U);
    EXPECT_EQ(scans[0]->getScanSize(), 101U);  // set up anew
    expectTheWall(*scans[0], 0.00501);
    m_emulator.locked([&] {
        m_device.sleep(true);
        m_device.sleep(false);  // power only: the port stays
    });
    m_sensor.getObservations();
    EXPECT_GE(take(m_sensor, 8).size(), 8U);
}

TEST_F(LaserFaults, ALaserThatKeepsAnotherFieldOfViewIsAnError) {
    m_emulator.locked([&] { m_device.holdView(true); });
    load(m_sensor, "COM_baudRate = 500000\nFOV = 100\n");
    m_sensor.initialize();
    m_sensor.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    for (int i = 0; i < 50 && m_sensor.getState() == mrpt::hwdrivers::CGenericSensor::ssWorking;
         ++i)
        m_sensor.doProcess();
    const std::string said =
        testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
    EXPECT_TRUE(
        contains(said, port() + ": the laser sends 361 readings, FOV and resolution make 201"))
        << said;
    EXPECT_TRUE(m_sensor.getObservations().empty());
}

TEST_F(LaserFaults, AClockThatJumpsBackDoesNotStopTheScans) {
    start();
    mrpt::Clock::setActiveClock(mrpt::Clock::Simulated);
    std::size_t scans = 0;
    for (const double time : {1000.0, 1001.0, 500.0, 501.0}) {
        mrpt::Clock::setSimulatedTime(mrpt::Clock::fromDouble(time));
        EXPECT_NO_THROW(scans += take(m_sensor, 1).size());
    }
    mrpt::Clock::setActiveClock(mrpt::Clock::Realtime);
    EXPECT_GE(scans, 4U);
    EXPECT_EQ(m_sensor.counts().reconnections, 0U);
}
