// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "CEviD30.h"
#include "CProcess.h"
#include "CTemporaryFolder.h"

namespace salma {
namespace {

using test::CEmulator;
using test::EFault;
using test::TProcessResult;

TProcessResult ptz(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{test::program("salma-ptz")};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return test::runProcess(command);
}

void expectOneLineError(const TProcessResult& result, const std::string& part) {
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_EQ(result.output.find("salma-ptz: "), 0U) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

/// The program, and an emulated camera at the end of a pseudo-terminal.
class SalmaPtz : public testing::Test {
 protected:
    TProcessResult camera(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), port());
        return ptz(arguments);
    }
    std::string port() const { return (m_folder / "camera").string(); }

    void expectHeadAt(double panCounts, double tiltCounts) {
        m_emulator.locked([&] {
            EXPECT_NEAR(m_device.pan().at(CEmulator::now()), panCounts, 1e-9);
            EXPECT_NEAR(m_device.tilt().at(CEmulator::now()), tiltCounts, 1e-9);
        });
    }

    test::CTemporaryFolder m_folder;
    test::CEviD30 m_device;
    CEmulator m_emulator{m_device, port()};
};

}  // namespace

TEST_F(SalmaPtz, HelpStartsWithTwoExamples) {
    const auto result = ptz({"--help"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.output.find("Examples:\n  salma-ptz /dev/ttyS0 status\n  salma-ptz "), 0U)
        << result.output;
    EXPECT_EQ(ptz({"--version"}).exitCode, 0);
    EXPECT_EQ(ptz({"--version"}).output.find("salma-ptz "), 0U);
}

TEST_F(SalmaPtz, TellsWhereTheCameraLooks) {
    const auto result = camera({"status"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(
        result.output,
        "pan       0.00 deg\ntilt      0.00 deg\nzoom      1.00, 0 counts\nfield    48.80 deg\n");
}

TEST_F(SalmaPtz, MovesAndSaysWhereItIsThen) {
    const auto result = camera({"move", "20", "-5"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(
        result.output,
        "pan      20.00 deg\ntilt     -5.00 deg\nzoom      1.00, 0 counts\nfield    48.80 deg\n");
    expectHeadAt(176, -60);
}

TEST_F(SalmaPtz, TakesNegativeAnglesAndASpeedAndDifferences) {
    EXPECT_EQ(camera({"move", "-10", "-2.5", "--speed", "60"}).exitCode, 0);
    expectHeadAt(-88, -30);
    EXPECT_EQ(camera({"move", "--relative", "-5", "2.5"}).exitCode, 0);
    expectHeadAt(-132, 0);
}

TEST_F(SalmaPtz, ZoomsGoesHomeAndStops) {
    EXPECT_NE(camera({"zoom", "1.5"}).output.find("zoom      1.50, 168 counts"), std::string::npos);
    EXPECT_EQ(camera({"move", "5", "5"}).exitCode, 0);
    EXPECT_EQ(camera({"home"}).exitCode, 0);
    expectHeadAt(0, 0);
    EXPECT_EQ(camera({"stop"}).exitCode, 0);
}

TEST_F(SalmaPtz, ReadsTheSectionOfAGrabberFile) {
    const auto ini = m_folder.write("grab.ini",
                                    "[global]\nrawlog_prefix = x\n[EYE]\ndriver = "
                                    "CPanTiltCameraSensor\nprocess_rate = 5\npan_counts_per_deg = "
                                    "-8.8\nport = /no/such/port\n");
    EXPECT_EQ(camera({"move", "10", "0", "--config", ini, "--section", "EYE"}).exitCode, 0);
    expectHeadAt(-88, 0);
    expectOneLineError(ptz({"--config", ini, "--section", "EYE", "/no/port", "status"}),
                       "/no/port: no such serial port");
    expectOneLineError(camera({"status", "--config", ini}), "grab.ini: has no section [HEAD]");
    const auto bad = m_folder.write("bad.ini", "[HEAD]\npan_max_degrees = 10\n");
    expectOneLineError(camera({"status", "--config", bad}), "unknown keys: pan_max_degrees");
}

TEST_F(SalmaPtz, PrintsASectionThatItReads) {
    const auto printed = ptz({"--print-config"});
    EXPECT_EQ(printed.exitCode, 0);
    EXPECT_EQ(printed.output.find("[HEAD]\n"), 0U) << printed.output;
    const auto ini = m_folder.write("printed.ini", printed.output);
    EXPECT_EQ(ptz({"--print-config", "--config", ini}).output, printed.output);
    EXPECT_EQ(camera({"status", "--config", ini}).exitCode, 0);
}

TEST_F(SalmaPtz, MistakesAndFaultsAreOneLine) {
    expectOneLineError(camera({"move", "120", "0"}), "pan 120 deg is outside [-100, 100] deg");
    expectOneLineError(camera({"move", "0", "nan"}), "tilt");
    expectOneLineError(camera({"move", "0", "0", "--speed", "0"}), "speed 0 deg/s is outside");
    expectOneLineError(camera({"zoom", "20"}), "zoom 20 is outside [1, 11.");
    expectOneLineError(ptz({"/no/such/port", "status"}), "/no/such/port: no such serial port");
    expectOneLineError(ptz({"/dev/null", "status"}), "/dev/null: is not a serial port");
    m_emulator.locked([&] {  // the first two packets make the connection
        m_device.misbehave({EFault::none, EFault::none, EFault::notExecutable});
    });
    expectOneLineError(camera({"home"}), "camera 1: not executable in its present state (41)");
    m_emulator.locked([&] { m_device.sleep(true); });
    expectOneLineError(camera({"status"}), "camera 1: no answer");
}

TEST_F(SalmaPtz, MisuseIsExitCodeTwo) {
    EXPECT_EQ(ptz({}).exitCode, 2);
    EXPECT_EQ(ptz({"status"}).exitCode, 2);
    EXPECT_EQ(camera({}).exitCode, 2);
    EXPECT_EQ(camera({"move", "1"}).exitCode, 2);
    EXPECT_EQ(camera({"move", "left", "0"}).exitCode, 2);
    EXPECT_EQ(camera({"status", "--fast"}).exitCode, 2);
    EXPECT_EQ(camera({"dance"}).exitCode, 2);
}

}  // namespace salma
