// SPDX-License-Identifier: BSD-3-Clause
// MRPT's rawlog-grabber, as it is installed, with the plug-in and emulated devices.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <messages.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CRawlog.h>
#include <salma/drivers/CViscaCamera.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/CObservationPanTilt.h>
#include <salma/observations/registerClasses.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <future>

#include "CEviD30.h"
#include "CProcess.h"
#include "CSickLms200.h"
#include "CTalker.h"
#include "CTemporaryFolder.h"
#include "stockProgram.h"

using namespace salma;
using mrpt::RAD2DEG;
using observations::CObservationPanTilt;

namespace {

using salma::test::contains;

class RawlogGrabber : public testing::Test {
 protected:
    void SetUp() override {
        if (std::system("command -v rawlog-grabber >/dev/null") != 0)
            GTEST_SKIP() << "SKIPPED, rawlog-grabber of package mrpt-apps is not here";
        ASSERT_EQ(mkfifo((m_folder / "keys").c_str(), 0600), 0);
        // Open for reading as well: opens at once, and the grabber never sees an end of file,
        // which it would take for a key.
        m_keys = open((m_folder / "keys").c_str(), O_RDWR | O_CLOEXEC);
        ASSERT_GE(m_keys, 0);
    }
    void TearDown() override { close(m_keys); }

    std::string port() const { return (m_folder / "camera").string(); }

    void grab(const std::string& cameraSection) {
        grabSections(
            "[HEAD]\ndriver = CPanTiltCameraSensor\nprocess_rate = 50\nsensorLabel = "
            "HEAD\n" +
            cameraSection);
    }

    void grabSections(const std::string& sections) {
        const std::string ini = m_folder.write(
            "grab.ini", "[global]\nrawlog_prefix = " + (m_folder / "log").string() +
                            "\nGRABBER_PERIOD_MS = 20\ntime_between_launches = 0\n" + sections);
        auto command = test::stockProgram("sh");
        const std::string line =
            "exec rawlog-grabber -p " SALMA_PLUGIN " " + ini + " < " + (m_folder / "keys").string();
        command.insert(command.end(), {"-c", line});
        m_grabber = std::async(std::launch::async, [command] { return test::runProcess(command); });
    }

    /// Waits until the camera was asked `more` times; false if the grabber ended before.
    bool waitForQuestions(test::CEmulator& emulator, const test::CEviD30& camera, int more) {
        const auto asked = [&] {
            int questions = 0;
            emulator.locked([&] { questions = camera.inquiries(); });
            return questions;
        };
        const int until = asked() + more;
        while (asked() < until)
            if (m_grabber.wait_for(std::chrono::milliseconds(5)) == std::future_status::ready)
                return false;
        return true;
    }

    test::TProcessResult end() {
        [[maybe_unused]] const auto written = write(m_keys, "q\n", 2);
        return m_grabber.get();
    }

    /// The file that the grabber has written; "" if there is none.
    std::string logFile() const {
        for (const auto& entry : std::filesystem::directory_iterator(m_folder.path()))
            if (entry.path().extension() == ".rawlog") return entry.path().string();
        return "";
    }

    /// What is in it, in its order.
    template <class RECORD = CObservationPanTilt>
    std::vector<std::shared_ptr<RECORD>> records() const {
        observations::registerClasses();
        mrpt::obs::CRawlog log;
        EXPECT_TRUE(log.loadFromRawLogFile(logFile()));
        std::vector<std::shared_ptr<RECORD>> all;
        for (std::size_t i = 0; i < log.size(); ++i)
            all.push_back(std::dynamic_pointer_cast<RECORD>(log.getAsObservation(i)));
        return all;
    }

    test::CTemporaryFolder m_folder;
    int m_keys{-1};
    std::future<test::TProcessResult> m_grabber;
};

}  // namespace

TEST_F(RawlogGrabber, WritesWhereTheHeadStands) {
    test::CEviD30 device;
    test::CEmulator emulator(device, port());
    {
        drivers::CViscaCamera camera(port());
        camera.moveTo(mrpt::DEG2RAD(20.0), mrpt::DEG2RAD(-5.0));
        camera.wait();
    }
    grab("port = " + port() + "\nbase_x_m = 0.2\nbase_z_m = 1.1\n");
    const bool asked = waitForQuestions(emulator, device, 60);
    const auto result = end();
    ASSERT_TRUE(asked) << result.output;
    EXPECT_EQ(result.exitCode, 0) << result.output;
    const auto states = records();
    ASSERT_GE(states.size(), 20U) << result.output;
    for (std::size_t i = 0; i < states.size(); ++i) {
        ASSERT_TRUE(states[i]);
        EXPECT_EQ(states[i]->sensorLabel, "HEAD");
        EXPECT_NEAR(RAD2DEG(states[i]->pan), 20, 1e-9);
        EXPECT_NEAR(RAD2DEG(states[i]->tilt), -5, 1e-9);
        EXPECT_NEAR(states[i]->zoom, 1, 1e-12);
        EXPECT_NEAR(states[i]->cameraPose().x(), 0.2, 1e-9);
        if (i == 0) continue;
        EXPECT_GT(states[i]->timestamp, states[i - 1]->timestamp);
    }
    // salma's own reader takes the log and knows where the camera was between two records.
    const auto log = observations::readLog(logFile());
    const double between = (mrpt::Clock::toDouble(states[3]->timestamp) +
                            mrpt::Clock::toDouble(states[4]->timestamp)) /
                           2;
    const auto pose = log.panTilt.cameraPose(between, 0);
    ASSERT_TRUE(pose);
    EXPECT_LT(pose->distanceTo(states[0]->cameraPose()), 1e-9);
}

TEST_F(RawlogGrabber, GoesOnAfterTheCableWasOut) {
    test::CEviD30 device;
    test::CEmulator emulator(device, port());
    grab("port = " + port() + "\nreconnect_s = 0.05\nreply_timeout_s = 0.1\n");
    const bool before = waitForQuestions(emulator, device, 20);
    const double out = test::CEmulator::now();
    emulator.unplug();
    emulator.plug();
    const bool after = waitForQuestions(emulator, device, 40);
    const auto result = end();
    ASSERT_TRUE(before && after) << result.output;
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_TRUE(contains(result.output, "camera lost: " + port())) << result.output;
    EXPECT_TRUE(contains(result.output, "camera found again")) << result.output;
    int earlier = 0, later = 0;
    for (const auto& state : records())
        ++(mrpt::Clock::toDouble(state->timestamp) < out ? earlier : later);
    EXPECT_GT(earlier, 0);
    EXPECT_GT(later, 0);
}

TEST_F(RawlogGrabber, SaysWhichPortIsNotThere) {
    grab("port = /dev/no-such-port\n");
    const auto result = m_grabber.get();
    EXPECT_LT(result.exitCode, 128) << result.output;  // no signal
    EXPECT_TRUE(contains(result.output, "/dev/no-such-port: no such serial port")) << result.output;
}

TEST_F(RawlogGrabber, SaysWhichKeyIsWrong) {
    grab("port = " + port() + "\npan_counts_per_degree = 8\n");
    const auto result = m_grabber.get();
    EXPECT_LT(result.exitCode, 128) << result.output;
    EXPECT_TRUE(contains(result.output, "(HEAD) has unknown keys: pan_counts_per_degree"))
        << result.output;
}

TEST_F(RawlogGrabber, WritesTheScansOfALaserAndGoesOnAfterTheCableWasOut) {
    test::CSickLms200 device(
        [](const test::TLmsView& view, double) { return std::vector<double>(view.beams(), 2); });
    test::CEmulator emulator(device, port());
    grabSections(
        "[LASER]\ndriver = CLms200\nprocess_rate = 90\nsensorLabel = LASER\n"
        "COM_port_LIN = " +
        port() + "\nCOM_baudRate = 500000\nFOV = 100\nresolution = 100\n" + "reconnect_s = 0.05\n");
    const auto waitForScans = [&](int n) {
        const auto streamed = [&] {
            int scans = 0;
            emulator.locked([&] { scans = device.scans(); });
            return scans;
        };
        for (const int until = streamed() + n; streamed() < until;)
            if (m_grabber.wait_for(std::chrono::milliseconds(5)) == std::future_status::ready)
                return false;
        return true;
    };
    const bool before = waitForScans(50);
    const double out = test::CEmulator::now();
    emulator.unplug();
    emulator.locked([&] { device.sleep(false); });  // without power as well
    emulator.plug();
    const bool after = waitForScans(100);
    const auto result = end();
    ASSERT_TRUE(before && after) << result.output;
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_TRUE(contains(result.output, "laser lost: " + port())) << result.output;
    EXPECT_TRUE(contains(result.output, "laser found again at " + port())) << result.output;
    int earlier = 0, later = 0;
    for (const auto& scan : records<mrpt::obs::CObservation2DRangeScan>()) {
        ASSERT_TRUE(scan);
        ASSERT_EQ(scan->getScanSize(), 101U);
        EXPECT_NEAR(RAD2DEG(scan->aperture), 100, 1e-4);
        EXPECT_NEAR(scan->getScanRange(50), 2, 1e-6);
        ++(mrpt::Clock::toDouble(scan->timestamp) < out ? earlier : later);
    }
    EXPECT_GE(earlier, 20);
    EXPECT_GE(later, 20);
}

/// With the base beside it: all that drivers has, in the stock program.
TEST_F(RawlogGrabber, WritesTheSweepsOfANoddingLaserAndTheOdometryOfABase) {
    test::CSickLms200 laser(
        [](const test::TLmsView& view, double) { return std::vector<double>(view.beams(), 2); });
    test::CTalker mount("NOD", 50, [](double now) {  // from -20 to 40 deg and back in two seconds
        const double phase = std::fmod(now, 2.0);
        return std::vector<double>{phase < 1 ? -20 + 60 * phase : 100 - 60 * phase};
    });
    test::CTalker base("ODO", 20, [](double) { return std::vector<double>{1, 2, 90}; });
    const std::string ports = (m_folder / "").string();
    test::CEmulator laserEnd(laser, ports + "laser"), mountEnd(mount, ports + "mount"),
        baseEnd(base, ports + "base");
    grabSections(
        "[NODDING]\ndriver = CNoddingLaser\nprocess_rate = 500\nsensorLabel = NODDING\n"
        "COM_baudRate = 500000\nresolution = 100\nCOM_port_LIN = " +
        ports + "laser\nmount_port = " + ports +
        "mount\n[BASE]\ndriver = CWheelOdometry\nprocess_rate = 200\nsensorLabel = BASE\n"
        "port = " +
        ports + "base\n");
    const auto scans = [&] {
        int streamed = 0;
        laserEnd.locked([&] { streamed = laser.scans(); });
        return streamed;
    };
    while (scans() < 450 &&
           m_grabber.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready) {
    }
    const auto result = end();
    EXPECT_EQ(result.exitCode, 0) << result.output;
    mrpt::obs::CRawlog log;
    ASSERT_TRUE(log.loadFromRawLogFile(logFile())) << result.output;
    std::size_t clouds = 0, odometry = 0;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const auto record = log.getAsObservation(i);
        if (const auto cloud =
                std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(record)) {
            ++clouds;
            EXPECT_EQ(cloud->sensorLabel, "NODDING_CLOUD");
            EXPECT_GE(cloud->pointcloud->size(), 181U * 20);
        } else if (const auto odo =
                       std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(record)) {
            ++odometry;
            EXPECT_NEAR(odo->odometry.y(), 2, 1e-9);
        }
    }
    EXPECT_GE(clouds, 2U) << result.output;
    EXPECT_GE(odometry, 20U) << result.output;
}

TEST_F(RawlogGrabber, SaysWhichLaserIsNotThere) {
    grabSections("[LASER]\ndriver = CLms200\nprocess_rate = 90\nCOM_port_LIN = /dev/no-such\n");
    const auto result = m_grabber.get();
    EXPECT_LT(result.exitCode, 128) << result.output;
    EXPECT_TRUE(contains(result.output, "/dev/no-such: no such serial port")) << result.output;
}

TEST_F(RawlogGrabber, SaysWhichDriverItDoesNotKnow) {
    grabSections("[LASER]\ndriver = CLms300\nprocess_rate = 90\n");
    const auto result = m_grabber.get();
    EXPECT_LT(result.exitCode, 128) << result.output;
    EXPECT_TRUE(contains(result.output, "Class name not recognized: CLms300")) << result.output;
}
