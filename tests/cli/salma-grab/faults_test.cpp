// SPDX-License-Identifier: BSD-3-Clause
// Sensors, clocks and disks that fail while salma-grab records.
#include <salma/observations/CLogReader.h>
#include <salma/observations/repairLog.h>

#include <algorithm>
#include <filesystem>

#include "emulatedRobot.h"

namespace fs = std::filesystem;

namespace salma {

using test::contains;
class SalmaGrabFaults : public test::CRobotTest {};

TEST_F(SalmaGrabFaults, TheOthersGoOnWhenASensorDies) {
    addSensor("LASER", "laser", 75);
    addSensor("CAMERA", "picture", 10, "fail_at = 5\n");
    const auto result = grab({ini(), "--duration", "2"});
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_TRUE(contains(result.output, "CAMERA failed: device is gone")) << result.output;
    EXPECT_EQ(given("CAMERA").size(), 5U);
    EXPECT_GT(given("LASER").size(), 100U);
    expectAllRecorded();
}

TEST_F(SalmaGrabFaults, AllStopWithADeadSensorIfToldTo) {
    addSensor("LASER", "laser", 75);
    addSensor("CAMERA", "picture", 10, "fail_at = 5\n");
    const auto result = grab({ini("[salma-grab]\non_sensor_failure = stop\n")});
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_TRUE(contains(result.output, "ended by its sensors")) << result.output;
    expectAllRecorded();
}

TEST_F(SalmaGrabFaults, ASensorIsStartedAgainUntilItIsThere) {
    addSensor("LASER", "laser", 75, "failures_at_start = 3\n");
    addSensor("HEAD", "head", 20);
    const auto result = grab(
        {ini("[salma-grab]\non_sensor_failure = restart\nrestart_s = 0.1\n"), "--duration", "2"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_TRUE(contains(result.output, "LASER failed: device is not there")) << result.output;
    EXPECT_TRUE(contains(result.output, "failed 3 times")) << result.output;
    expectAllRecorded();
}

TEST_F(SalmaGrabFaults, ASensorThatHangsIsLeftBehind) {
    addSensor("LASER", "laser", 75);
    addSensor("HEAD", "head", 20, "hang_at = 7\n");
    const auto result =
        grab({ini("[salma-grab]\nstop_s = 0.5\nsilent_s = 0.5\n"), "--duration", "1.5"});
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_TRUE(contains(result.output, "HEAD: nothing for 0.5 s")) << result.output;
    EXPECT_TRUE(contains(result.output, "HEAD does not end and was left behind")) << result.output;
    // What its driver held back when it hung never reached the grabber.
    EXPECT_GE(recorded(companion())["HEAD"].size(), 6U);
    forgive("HEAD");
    expectAllRecorded();
}

TEST_F(SalmaGrabFaults, AClockThatJumpsBackLosesNothing) {
    addSensor("LASER", "laser", 75, "jump_at = 60\njump_s = -3600\n");
    addSensor("HEAD", "head", 20);
    const auto result = grab({ini(), "--duration", "2"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_TRUE(contains(result.output, "LASER: its clock jumped back by 3599.")) << result.output;
    auto got = recorded(log())["LASER"];
    // The records around the jump are in order of their stamps, not of their arrival.
    std::sort(got.begin(), got.end());
    const auto sent = given("LASER");
    ASSERT_EQ(got.size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_EQ(got[i].first, sent[i].first);
}

TEST_F(SalmaGrabFaults, PicturesOfNoUseAreReported) {
    addSensor("CAMERA", "picture", 10, "black_from = 3\n");
    addSensor("OTHER", "picture", 10, "small_from = 3\n");
    const auto result = grab({ini(), "--duration", "2.5"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_TRUE(contains(result.output, "CAMERA: a picture is black (CAMERA_")) << result.output;
    EXPECT_TRUE(contains(result.output,
                         "OTHER: a picture is 160 x 120 instead of the first one's 320 x 240"))
        << result.output;
    expectAllRecorded();
}

TEST_F(SalmaGrabFaults, AFullDiskIsToldAndTheLogStaysWhole) {
    addSensor("LASER", "laser", 75);
    std::string line = "ulimit -f 150; exec";  // of 512 bytes
    for (const auto& word : command({ini()})) line += " " + word;
    const auto result = test::runProcess({"sh", "-c", line});
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_TRUE(contains(result.output, "x.rawlog: cannot be written: File too large"))
        << result.output;
    EXPECT_TRUE(observations::repairLog(log(), log()).whole);
    const auto got = recorded(log())["LASER"];
    EXPECT_GT(got.size(), 30U);
    EXPECT_LT(got.size(), given("LASER").size());
}

TEST_F(SalmaGrabFaults, ADeviceWithoutSpaceIsTold) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "SKIPPED, no /dev/full here";
    addSensor("LASER", "laser", 75);
    fs::create_symlink("/dev/full", log());
    const auto result = grab({ini(), "--overwrite"});
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_TRUE(contains(result.output, "cannot be written: No space left on device"))
        << result.output;
}

TEST_F(SalmaGrabFaults, AFolderThatCannotBeWrittenIsTold) {
    addSensor("LASER", "laser", 75);
    const std::string config = ini();
    const auto to = [&](const std::string& place) {
        return test::runProcess(
            {test::program("salma-grab"), "-p", SALMA_EMULATED_SENSORS, config, "--out", place});
    };
    const auto missing = to("/no/such/folder/x.rawlog");
    EXPECT_EQ(missing.exitCode, 1) << missing.output;
    EXPECT_TRUE(contains(missing.output, "/no/such/folder/x.rawlog: cannot be written: No such"))
        << missing.output;
    const auto refused = to("/proc/x.rawlog");
    EXPECT_EQ(refused.exitCode, 1) << refused.output;
    EXPECT_TRUE(contains(refused.output, "/proc/x.rawlog: cannot be written: ")) << refused.output;
    EXPECT_EQ(given("LASER").size(), 0U);  // told before a sensor starts
}

}  // namespace salma
