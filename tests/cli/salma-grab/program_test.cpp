// SPDX-License-Identifier: BSD-3-Clause
// salma-grab as a process, with sensors that number what they give.
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <salma/observations/CLogReader.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "emulatedRobot.h"
#include "stockProgram.h"

namespace fs = std::filesystem;

namespace salma {

using test::contains;
class SalmaGrab : public test::CRobotTest {};

namespace {

void expectOneLineError(const test::TProcessResult& result, const std::string& part) {
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_TRUE(contains(result.output, "salma-grab: ")) << result.output;
    EXPECT_TRUE(contains(result.output, part)) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

std::size_t filesIn(const fs::path& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_F(SalmaGrab, HelpStartsWithTwoExamples) {
    const auto help = test::runProcess({test::program("salma-grab"), "--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.output.find("Examples:\n  salma-grab robot.ini --out out/drive.rawlog\n"
                               "  salma-grab --repair out/drive.rawlog\n"),
              0U)
        << help.output;
    const auto version = test::runProcess({test::program("salma-grab"), "--version"});
    EXPECT_EQ(version.exitCode, 0);
    EXPECT_EQ(version.output.find("salma-grab "), 0U);
}

TEST_F(SalmaGrab, RecordsAllSensorsInOrderOfTime) {
    addUsualSensors();
    const auto result = grab({ini(), "--duration", "2.5"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    expectAllRecorded();
    // Records of different sensors are in order, too; no stock program meets salma's classes.
    observations::TLogReaderOptions alone;
    alone.mergeCompanion = false;
    const auto all = observations::readLog(log(), alone);
    EXPECT_EQ(all.counts.size(), 2U);
    mrpt::io::CFileGZInputStream in(log());
    auto archive = mrpt::serialization::archiveFrom(in);
    double last = 0;
    for (std::size_t i = 0; i < all.steps.size(); ++i) {
        const auto record =
            std::dynamic_pointer_cast<mrpt::obs::CObservation>(archive.ReadObject());
        const double stamp = mrpt::Clock::toDouble(record->timestamp);
        EXPECT_GE(stamp, last) << i;
        last = stamp;
    }
    // One picture file for each record of the camera.
    EXPECT_EQ(filesIn(m_folder / "x_Images"), given("CAMERA").size());
    EXPECT_EQ(observations::readLog(log()).counts.size(), 3U);
}

TEST_F(SalmaGrab, StockProgramsReadEveryObject) {
    addUsualSensors();
    ASSERT_EQ(grab({ini(), "--duration", "1.5"}).exitCode, 0);
    if (std::system("command -v rawlog-edit >/dev/null") != 0)
        GTEST_SKIP() << "SKIPPED, rawlog-edit of package mrpt-apps is not here";
    const auto info = test::runProcess({"rawlog-edit", "--info", "-i", log()}).output;
    const auto laser = given("LASER").size(), camera = given("CAMERA").size();
    EXPECT_TRUE(contains(
        info, "Overall number of objects         : " + std::to_string(laser + camera) + "\n"))
        << info;
    // It looks for the pictures of a file in its own folder only.
    const auto beside = test::runProcess(
        {"sh", "-c", "cd " + m_folder.path().string() + " && rawlog-edit --info -i x.rawlog"});
    EXPECT_TRUE(contains(beside.output, "Found external storage directory")) << beside.output;
    auto withPlugin = test::stockProgram("rawlog-edit");
    withPlugin.insert(withPlugin.end(), {"-p", SALMA_PLUGIN, "--info", "-i", companion()});
    const auto head = test::runProcess(withPlugin).output;
    EXPECT_TRUE(contains(
        head, "Overall number of objects         : " + std::to_string(given("HEAD").size()) + "\n"))
        << head;
}

TEST_F(SalmaGrab, SignalsThatEndItLoseNothing) {
    addUsualSensors();
    const std::string config = ini();
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        for (const auto& name : m_names) fs::remove(m_folder / (name + ".txt"));
        test::CRunningProcess process(command({config, "--overwrite"}));
        ASSERT_TRUE(waitFor("LASER", 90, process)) << process.wait().output;
        process.signal(number);
        process.signal(number);  // impatience costs nothing either
        const auto result = process.wait();
        EXPECT_EQ(result.exitCode, 0) << result.output;
        EXPECT_TRUE(contains(result.output, std::string("ended by SIG"))) << result.output;
        expectAllRecorded();
    }
}

TEST_F(SalmaGrab, EmbedsEverythingIfToldTo) {
    addUsualSensors();
    const auto result =
        grab({ini("[salma-grab]\nexternal_pictures = false\n"), "--duration", "1.2", "--embed"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_FALSE(fs::exists(companion()));
    EXPECT_FALSE(fs::exists(m_folder / "x_Images"));
    expectAllRecorded();
}

TEST_F(SalmaGrab, TakesTheCommandLineOfRawlogGrabber) {
    addSensor("LASER", "laser", 75);
    const std::string config = m_folder.write(
        "stock.ini", "[global]\nrawlog_prefix = " + (m_folder / "drive").string() +
                         "\ntime_between_launches = 0\nuse_sensoryframes = 0\nGRABBER_PERIOD_MS = "
                         "1000 // of rawlog-grabber\n" +
                         m_sections + "[NOTES]\nrawlog-grabber-ignore = true\nwho = me\n");
    // Also with the plug-in whose classes the program has built in.
    const auto result = test::runProcess({test::program("salma-grab"), "-p",
                                          std::string(SALMA_EMULATED_SENSORS) + "," + SALMA_PLUGIN,
                                          config, "--duration", "1"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_FALSE(contains(result.output, "Warning")) << result.output;
    std::string found;
    for (const auto& entry : fs::directory_iterator(m_folder.path()))
        if (entry.path().extension() == ".rawlog") found = entry.path().filename().string();
    EXPECT_EQ(found.find("drive_20"), 0U) << found;
    EXPECT_EQ(found.size(), std::string("drive_2026-11-22_10h20m30s.rawlog").size()) << found;
}

TEST_F(SalmaGrab, WritesSensoryFramesWithTheMotionBetweenThem) {
    addSensor("ODO", "odometry", 10);
    addSensor("LASER", "laser", 40);
    const auto result =
        grab({m_folder.write("robot.ini", m_head + "use_sensoryframes = true\n" + m_sections),
              "--duration", "1.5"});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    mrpt::io::CFileGZInputStream in(log());
    auto archive = mrpt::serialization::archiveFrom(in);
    double driven = 0;
    std::size_t actions = 0, scans = 0;
    try {
        while (true) {
            const auto object = archive.ReadObject();
            if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
                scans += frame->size();
            if (const auto collection =
                    std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object)) {
                ++actions;
                driven += collection->getBestMovementEstimation()->poseChange->getMeanVal().x();
            }
        }
    } catch (const mrpt::serialization::CExceptionEOF&) {
    }
    EXPECT_EQ(scans, given("LASER").size());  // the last, partial frame is there
    EXPECT_EQ(actions, given("ODO").size());
    // Odometry starts at 1 m: the first action must not contain that.
    EXPECT_NEAR(driven, 0.01 * static_cast<double>(actions - 1), 1e-6);
}

TEST_F(SalmaGrab, PrintsAConfigurationThatItReads) {
    const std::string grabber = test::program("salma-grab");
    const auto printed = test::runProcess({grabber, "--print-config"});
    EXPECT_EQ(printed.exitCode, 0) << printed.output;
    const auto again = test::runProcess(
        {grabber, m_folder.write("printed.ini", printed.output), "--print-config"});
    EXPECT_EQ(again.output, printed.output);
}

TEST_F(SalmaGrab, ExistingResultsAreNotTouched) {
    addUsualSensors();
    const std::string config = ini();
    const std::string kept = m_folder.write("x.rawlog", "precious");
    expectOneLineError(grab({config, "--duration", "1"}), "x.rawlog: cannot be written: exists");
    EXPECT_EQ(test::readFile(kept), "precious");
    fs::remove(kept);
    fs::create_directory(m_folder / "x_Images");
    m_folder.write("x_Images/old.jpg", "precious");
    expectOneLineError(grab({config, "--duration", "1"}), "x_Images: exists");
    EXPECT_FALSE(fs::exists(kept));
    EXPECT_EQ(grab({config, "--duration", "1", "--overwrite"}).exitCode, 0);
    EXPECT_FALSE(fs::exists(m_folder / "x_Images/old.jpg"));
    EXPECT_GT(filesIn(m_folder / "x_Images"), 0U);
}

TEST_F(SalmaGrab, MistakesInTheIniFileAreOneLine) {
    const auto with = [&](const std::string& text) {
        return grab({m_folder.write("bad.ini", text), "--duration", "1"});
    };
    expectOneLineError(with("[global]\n"), "names no sensor");
    expectOneLineError(with("[A]\nprocess_rate = 1\n"), "[A] has no driver");
    expectOneLineError(with("[A]\ndriver = CNoSuchSensor\n"),
                       "[A] driver = 'CNoSuchSensor' is not known");
    expectOneLineError(with("[A]\ndriver = CEmulatedSensor\n"), "[A] process_rate must be more");
    expectOneLineError(with("[A]\ndriver = CEmulatedSensor\nprocess_rate = 1\ndevice_rate = -1\n"),
                       "[A] device_rate must be more than 0");
    expectOneLineError(with("[global]\nrawlog_prefx = x\n"), "unknown keys: rawlog_prefx");
    expectOneLineError(with("[salma-grab]\nhold_s = 0.5\nmember_s = 0.6\n"), "hold_s and member_s");
    expectOneLineError(with("[salma-grab]\non_sensor_failure = ignore\n"), "is not one of");
    expectOneLineError(with("driver\n"), "bad.ini:1");
    expectOneLineError(grab({"/no/such.ini"}), "/no/such.ini: no such file");
    EXPECT_FALSE(fs::exists(log()));
}

TEST_F(SalmaGrab, MisuseIsExitCodeTwo) {
    const std::string grabber = test::program("salma-grab");
    EXPECT_EQ(test::runProcess({grabber}).exitCode, 2);
    EXPECT_EQ(test::runProcess({grabber, "a.ini", "--repair", "x.rawlog"}).exitCode, 2);
    EXPECT_EQ(test::runProcess({grabber, "a.ini", "--duration", "-1"}).exitCode, 2);
    EXPECT_EQ(test::runProcess({grabber, "a.ini", "--fast"}).exitCode, 2);
}

}  // namespace salma
