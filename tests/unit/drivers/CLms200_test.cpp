// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <mrpt/core/bits_math.h>
#include <salma/config/CStrictFile.h>
#include <salma/drivers/CSerialLine.h>
#include <salma/drivers/registerSensors.h>

#include <algorithm>

#include "laserOnAPort.h"

using namespace salma;
using drivers::CLms200;
using mrpt::DEG2RAD;
using test::contains;
using test::messageOf;

namespace {

struct TMode {
    int fieldOfView, resolution;
    bool mm;
    std::size_t beams;
};

void PrintTo(const TMode& mode, std::ostream* out) {
    *out << mode.fieldOfView << "/" << mode.resolution << (mode.mm ? " mm" : " cm");
}

class LaserModes : public test::LaserOnAPort, public testing::WithParamInterface<TMode> {};

class Laser : public test::LaserOnAPort {};

}  // namespace

TEST_P(LaserModes, AScanIsWhereItsBeamsWent) {
    const TMode mode = GetParam();
    CLms200 sensor;
    load(sensor, "COM_baudRate = 500000\nFOV = " + std::to_string(mode.fieldOfView) +
                     "\nresolution = " + std::to_string(mode.resolution) +
                     "\nmm_mode = " + (mode.mm ? "true" : "false") +
                     "\npose_x = 0.2\npose_z = 0.4\npose_roll = 180\n");
    sensor.initialize();
    const auto scans = take(sensor, 3);
    ASSERT_GE(scans.size(), 3U);
    for (const auto& scan : scans) {
        EXPECT_EQ(scan->sensorLabel, "LASER");
        EXPECT_TRUE(scan->rightToLeft);
        EXPECT_NEAR(mrpt::RAD2DEG(scan->aperture), mode.fieldOfView, 1e-4);
        ASSERT_EQ(scan->getScanSize(), mode.beams);
        EXPECT_NEAR(scan->maxRange, mode.mm ? 32.7 : 81, 1e-4);
        // 5 mm of noise and the rounding's share, step / sqrt 12
        EXPECT_NEAR(scan->stdError, mode.mm ? 0.005008 : 0.005774, 1e-6);
        EXPECT_NEAR(scan->sensorPose.x(), 0.2, 1e-9);
        EXPECT_NEAR(std::abs(mrpt::RAD2DEG(scan->sensorPose.roll())), 180, 1e-9);
        expectTheWall(*scan, mode.mm ? 0.000501 : 0.00501);
    }
}

INSTANTIATE_TEST_SUITE_P(All,
                         LaserModes,
                         testing::Values(TMode{180, 50, true, 361},
                                         TMode{180, 100, true, 181},
                                         TMode{100, 50, true, 201},
                                         TMode{100, 100, true, 101},
                                         TMode{180, 50, false, 361},
                                         TMode{180, 100, false, 181},
                                         TMode{100, 50, false, 201},
                                         TMode{100, 100, false, 101}));

/// Why CLms200 exists: with MRPT's own driver a scan of 100 deg is spread over 180 deg.
TEST_F(Laser, MrptsOwnDriverGetsTheApertureWrong) {
    mrpt::hwdrivers::CSickLaserSerial stock;
    stock.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    stock.setSerialPort(port());
    stock.setBaudRate(500000);
    stock.setScanFOV(100);
    stock.initialize();
    const auto scans = take(stock, 1);
    ASSERT_GE(scans.size(), 1U);
    EXPECT_EQ(scans[0]->getScanSize(), 201U);
    EXPECT_NEAR(mrpt::RAD2DEG(scans[0]->aperture), 180, 1e-4);
}

TEST_F(Laser, IsFoundAtEveryRateAndSetToTheWantedOne) {
    const std::pair<int, int> changes[] = {{9600, 500000}, {500000, 38400}, {38400, 38400}};
    for (const auto& [from, to] : changes) {
        {
            CLms200 before;
            load(before, "COM_baudRate = " + std::to_string(from) + "\nresolution = 100\n");
            before.initialize();
        }
        CLms200 sensor;
        load(sensor, "COM_baudRate = " + std::to_string(to) + "\nresolution = 100\n");
        ASSERT_EQ(messageOf([&] { sensor.initialize(); }), "") << from << " to " << to;
        EXPECT_GE(take(sensor, 1).size(), 1U);
        int baud = 0;
        m_emulator.locked([&] { baud = m_device.baud(); });
        EXPECT_EQ(baud, to);
    }
}

TEST_F(Laser, ALaserThatStreamsAlreadyIsTakenOver) {
    {
        drivers::CSerialLine line(port(), 9600);
        line.write({0x02, 0x00, 0x02, 0x00, 0x20, 0x24, 0x34, 0x08});  // a program that crashed
        std::size_t bytes = 0;
        while (bytes < 50) bytes += line.read(1).size();
    }
    CLms200 sensor;
    load(sensor, "COM_baudRate = 38400\n");
    sensor.initialize();
    const auto scans = take(sensor, 2);
    ASSERT_GE(scans.size(), 2U);
    expectTheWall(*scans[0], 0.00501);
}

TEST_F(Laser, StopsTheLaserAtTheEnd) {
    {
        CLms200 sensor;
        load(sensor, "");
        sensor.initialize();
        EXPECT_EQ(sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssWorking);
    }
    m_emulator.locked([&] { EXPECT_FALSE(m_device.streaming()); });
}

/// At 9600 baud a telegram of 181 beams takes 0.38 s, by which MRPT's stamps are late.
TEST_F(Laser, AStampIsWhenTheScanBeganToComeAndNotWhenItWasRead) {
    CLms200 sensor;
    load(sensor, "COM_baudRate = 9600\nresolution = 100\nlatency_s = 0\n");
    sensor.initialize();
    const auto scans = take(sensor, 6);
    ASSERT_GE(scans.size(), 6U);
    std::vector<double> looks;
    m_emulator.locked([&] { looks = m_looks; });
    double soonest = 1e9;
    for (const auto& scan : scans) {
        const double stamp = mrpt::Clock::toDouble(scan->timestamp);
        const auto next = std::upper_bound(looks.begin(), looks.end(), stamp + 0.002);
        ASSERT_NE(next, looks.begin());
        soonest = std::min(soonest, stamp - *(next - 1));
    }
    EXPECT_LT(std::abs(soonest), 0.1);
    EXPECT_TRUE(std::is_sorted(scans.begin(), scans.end(), [](const auto& a, const auto& b) {
        return a->timestamp < b->timestamp;
    }));
}

TEST_F(Laser, IsKnownToMrptByItsName) {
    drivers::registerSensors();
    const auto sensor = mrpt::hwdrivers::CGenericSensor::createSensorPtr("CLms200");
    EXPECT_TRUE(std::dynamic_pointer_cast<CLms200>(sensor));
}

TEST_F(Laser, ItsSectionIsReadStrictly) {
    CLms200 sensor;
    const auto said = [&](const std::string& more) {
        return messageOf([&] { load(sensor, more); });
    };
    EXPECT_TRUE(contains(said("FOW = 100\n"), "unknown keys: FOW")) << said("FOW = 100\n");
    EXPECT_TRUE(contains(said("FOV = 90\n"), "(LASER) FOV = '90'")) << said("FOV = 90\n");
    EXPECT_TRUE(contains(said("resolution = 25\n"), "(LASER) resolution = '25'"));
    EXPECT_TRUE(contains(said("COM_baudRate = 19200\n"), "COM_baudRate = '19200'"));
    EXPECT_TRUE(contains(said("range_sigma_m = nan\n"), "range_sigma_m"));
}

TEST_F(Laser, TheSectionThatItPrintsCanBeRead) {
    const drivers::TLms200Options options;
    drivers::TLms200Options loaded;
    loaded.fieldOfView = 100;
    loaded.loadFromConfigFile(mrpt::config::CConfigFileMemory(options.asIni("LASER")), "LASER");
    EXPECT_EQ(loaded.asIni("LASER"), options.asIni("LASER"));
}

TEST_F(Laser, TheShippedSectionCanBeRead) {
    const auto file = config::openStrict(SALMA_SOURCE_DIR "/share/grabber/lms200.ini");
    drivers::TLms200Options options;
    EXPECT_NO_THROW(options.loadFromConfigFile(*file, "LASER"));
    EXPECT_EQ(options.fieldOfView, 180);
    EXPECT_TRUE(options.mmMode);
}

TEST_F(Laser, APortThatIsMissingInUseSilentOrNoneIsAnErrorThatNamesIt) {
    CLms200 sensor;
    load(sensor, "");
    {
        const drivers::CSerialLine other(port(), 9600);
        EXPECT_EQ(messageOf([&] { sensor.initialize(); }),
                  port() + ": is in use by another program");
    }
    m_emulator.locked([&] { m_device.sleep(true); });
    EXPECT_EQ(messageOf([&] { sensor.initialize(); }),
              port() + ": no LMS 200 answers there as it should, at any rate");
    m_emulator.unplug();
    EXPECT_EQ(messageOf([&] { sensor.initialize(); }),
              port() + ": no such serial port, or nothing is plugged in");
    const std::string file = m_folder.write("file", "no port");
    load(sensor, "COM_port_LIN = " + file + "\n");
}

TEST_F(Laser, WhileItIsUsedNobodyElseGetsThePort) {
    CLms200 sensor;
    load(sensor, "");
    sensor.initialize();
    EXPECT_TRUE(contains(messageOf([&] { drivers::CSerialLine other(port(), 9600); }),
                         "in use by another program"));
}
