// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/Clock.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <salma/drivers/CSerialLine.h>
#include <salma/drivers/CWheelOdometry.h>

#include <chrono>

#include "CTalker.h"
#include "CTemporaryFolder.h"

using namespace salma;
using drivers::CWheelOdometry;
using mrpt::obs::CObservationOdometry;

namespace {

class Base : public testing::Test {
 protected:
    std::string port() const { return (m_folder / "base").string(); }

    void load(const std::string& more = "") {
        m_sensor.setMinLoggingLevel(mrpt::system::LVL_ERROR);
        m_sensor.loadConfig(
            mrpt::config::CConfigFileMemory(
                "[BASE]\ndriver = CWheelOdometry\nprocess_rate = 500\nsensorLabel = "
                "WHEELS\nsilence_s = 0.5\nreconnect_s = 0.01\nport = " +
                port() + "\n" + more),
            "BASE");
    }

    /// Lets the sensor work until `n` records have come; fewer if that takes half a minute.
    std::vector<CObservationOdometry::Ptr> take(std::size_t n) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        std::vector<CObservationOdometry::Ptr> records;
        while (records.size() < n && std::chrono::steady_clock::now() < end) {
            m_sensor.doProcess();
            for (const auto& entry : m_sensor.getObservations())
                records.push_back(std::dynamic_pointer_cast<CObservationOdometry>(entry.second));
        }
        return records;
    }

    std::string startMessage() {
        try {
            m_sensor.initialize();
        } catch (const std::exception& error) {
            return error.what();
        }
        return "";
    }

    test::CTemporaryFolder m_folder;
    int m_steps{0};
    test::CTalker m_device{"ODO", 50, [this](double) {
                               ++m_steps;
                               return std::vector<double>{m_steps * 0.01, 2, -90};
                           }};
    test::CEmulator m_emulator{m_device, port()};
    CWheelOdometry m_sensor;
};

}  // namespace

TEST_F(Base, RecordsWhereTheWheelsHaveBroughtIt) {
    load();
    ASSERT_EQ(startMessage(), "");
    const auto records = take(20);
    ASSERT_GE(records.size(), 20U);
    for (std::size_t i = 0; i < records.size(); ++i) {
        EXPECT_EQ(records[i]->sensorLabel, "WHEELS");
        EXPECT_NEAR(records[i]->odometry.y(), 2, 1e-9);
        EXPECT_NEAR(mrpt::RAD2DEG(records[i]->odometry.phi()), -90, 1e-9);
        if (i == 0) continue;
        EXPECT_NEAR(records[i]->odometry.x(), records[i - 1]->odometry.x() + 0.01, 1e-9);
        EXPECT_GT(records[i]->timestamp, records[i - 1]->timestamp);
    }
}

TEST_F(Base, GarbledSentencesAreLeftOut) {
    m_emulator.locked([&] { m_device.garble(true); });
    load();
    ASSERT_EQ(startMessage(), "");
    for (const auto& record : take(10)) {
        EXPECT_NEAR(record->odometry.y(), 2, 1e-9);
        EXPECT_EQ(std::lround(record->odometry.x() * 100) % 4, 3);  // 1, 2 and 4 of each four broke
    }
}

TEST_F(Base, APortThatIsMissingOrSilentAtTheStartIsAnError) {
    load();
    m_emulator.locked([&] { m_device.silence(true); });
    {
        drivers::CSerialLine line(port(), 115200);  // what it said before is still on its way
        while (!line.read(0.1).empty()) {
        }
    }
    EXPECT_EQ(startMessage(), port() + ": no odometry ($ODO) comes from there");
    m_emulator.unplug();
    EXPECT_EQ(startMessage(), port() + ": no such serial port, or nothing is plugged in");
}

TEST_F(Base, ABaseThatIsLostIsLookedForAndFoundAgain) {
    load();
    ASSERT_EQ(startMessage(), "");
    EXPECT_GE(take(2).size(), 2U);
    m_emulator.unplug();
    for (int i = 0; i < 5; ++i) EXPECT_NO_THROW(m_sensor.doProcess());
    EXPECT_EQ(m_sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssError);
    m_sensor.getObservations();
    m_emulator.plug();
    EXPECT_GE(take(2).size(), 2U);
    EXPECT_EQ(m_sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssWorking);
}

TEST_F(Base, ItsSectionIsReadStrictly) {
    EXPECT_THROW(load("prot = x\n"), std::exception);
    const drivers::TWheelOdometryOptions options;
    drivers::TWheelOdometryOptions loaded;
    loaded.baud = 300;
    loaded.loadFromConfigFile(mrpt::config::CConfigFileMemory(options.asIni("BASE")), "BASE");
    EXPECT_EQ(loaded.asIni("BASE"), options.asIni("BASE"));
}
