// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <salma/observations/readCarmenLog.h>
#include <zlib.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "CTemporaryFolder.h"

using namespace salma;
using observations::readCarmenLog;
using observations::TCarmenLog;
using test::CTemporaryFolder;

namespace {

/// A line of `n` readings 1.00, 1.01, ... with the laser at (9, 8, 0.7) and the robot at `pose`.
std::string scanLine(int n, const std::string& pose, const std::string& stamp) {
    std::ostringstream line;
    line << "FLASER " << n;
    for (int i = 0; i < n; ++i) line << ' ' << 1 + 0.01 * i;
    line << " 9 8 0.7 " << pose << ' ' << stamp << " host " << stamp << '\n';
    return line.str();
}

std::string goodLog() {
    return "# message_name [message contents]\nPARAM robot_front_laser_max 40 1 h 1\n"
           "PARAM robot_frontlaser_offset -0.04 1 h 1\nODOM 1 2 3 0 0 0 5 h 5\n\n" +
           scanLine(5, "1 2 0.5", "10.25") + scanLine(5, "1.5 2 0.25", "10.5");
}

/// The message of a reader that must throw one line that begins with the file; "" if it does not.
std::string messageOf(const std::string& text) {
    const CTemporaryFolder folder;
    const std::string file = folder.write("a.log", text);
    try {
        readCarmenLog(file);
    } catch (const std::runtime_error& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_EQ(message.find(file + ": "), 0U) << message;
        return message.substr(std::min(message.size(), file.size() + 2));
    }
    ADD_FAILURE() << "was read";
    return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
}

void packInto(const std::string& file, const std::string& text) {
    gzFile stream = gzopen(file.c_str(), "wb");
    ASSERT_NE(stream, nullptr);
    ASSERT_EQ(gzwrite(stream, text.data(), static_cast<unsigned>(text.size())),
              static_cast<int>(text.size()));
    ASSERT_EQ(gzclose(stream), Z_OK);
}

void expectWhole(const TCarmenLog& log, std::size_t scans, std::size_t readings) {
    ASSERT_EQ(log.scans.size(), scans);
    for (const auto& entry : log.scans) {
        ASSERT_EQ(entry.scan->getScanSize(), readings);
        ASSERT_TRUE(std::isfinite(entry.odometry.norm()));
    }
}

}  // namespace

TEST(readCarmenLog, GivesScanAndTheSecondPoseOfEachLine) {
    const CTemporaryFolder folder;
    const TCarmenLog log = readCarmenLog(folder.write("a.log", goodLog()));
    ASSERT_EQ(log.scans.size(), 2U);
    EXPECT_EQ(log.scans[0].line, 6U);
    EXPECT_EQ(log.scans[1].line, 7U);
    EXPECT_DOUBLE_EQ(log.scans[0].odometry.x(), 1);
    EXPECT_DOUBLE_EQ(log.scans[0].odometry.y(), 2);
    EXPECT_DOUBLE_EQ(log.scans[0].odometry.phi(), 0.5);
    const auto& scan = *log.scans[0].scan;
    ASSERT_EQ(scan.getScanSize(), 5U);
    EXPECT_FLOAT_EQ(scan.getScanRange(4), 1.04F);
    EXPECT_FLOAT_EQ(scan.maxRange, 40);
    EXPECT_DOUBLE_EQ(scan.sensorPose.x(), -0.04);
    EXPECT_NEAR(mrpt::Clock::toDouble(scan.timestamp), 10.25, 1e-6);
    const std::map<std::string, std::size_t> skipped{{"#", 1}, {"ODOM", 1}, {"PARAM", 2}};
    EXPECT_EQ(log.skipped, skipped);
    EXPECT_EQ(log.backwards, 0U);
}

/// 180 readings are -90, -89, ..., +89 deg; 181 go up to +90.
TEST(readCarmenLog, EvenCountsLackTheLastBeam) {
    const CTemporaryFolder folder;
    for (const int n : {180, 181, 360, 361}) {
        const TCarmenLog log = readCarmenLog(folder.write("a.log", scanLine(n, "0 0 0", "1")));
        const auto& scan = *log.scans.front().scan;
        const double step = M_PI / (n / 2 * 2);
        const double first = scan.sensorPose.yaw() - scan.aperture / 2;
        EXPECT_NEAR(first, -M_PI / 2, 1e-6) << n;
        EXPECT_NEAR(first + (n - 1) * step, scan.sensorPose.yaw() + scan.aperture / 2, 1e-6) << n;
    }
}

TEST(readCarmenLog, MarksReadingsWithoutReturn) {
    const CTemporaryFolder folder;
    const auto line = replaced(scanLine(5, "0 0 0", "1"), "1.01 1.02", "0 81.91");
    const TCarmenLog log = readCarmenLog(folder.write("a.log", line));
    const auto& scan = *log.scans.front().scan;
    EXPECT_TRUE(scan.getScanRangeValidity(0));
    EXPECT_FALSE(scan.getScanRangeValidity(1));
    EXPECT_FALSE(scan.getScanRangeValidity(2));
    EXPECT_TRUE(scan.getScanRangeValidity(3));
}

TEST(readCarmenLog, KeepsTheOrderOfTheFileWhereStampsRunBackwards) {
    const CTemporaryFolder folder;
    const TCarmenLog log = readCarmenLog(folder.write(
        "a.log",
        scanLine(5, "1 0 0", "-0.5") + scanLine(5, "2 0 0", "-0.75") + scanLine(5, "3 0 0", "1")));
    ASSERT_EQ(log.scans.size(), 3U);
    EXPECT_EQ(log.backwards, 1U);
    EXPECT_DOUBLE_EQ(log.scans[1].odometry.x(), 2);
    EXPECT_DOUBLE_EQ(log.scans[1].time, -0.75);
}

TEST(readCarmenLog, ReadsWindowsLineEndsAndTwoPackedPartsInOneFile) {
    const CTemporaryFolder folder;
    std::string windows = goodLog();
    for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2)
        windows.insert(at, 1, '\r');
    expectWhole(readCarmenLog(folder.write("w.log", windows)), 2, 5);
    const std::string part = (folder / "part.gz").string();
    packInto(part, goodLog());
    const std::string packed = test::readFile(part);
    expectWhole(readCarmenLog(folder.write("two.gz", packed + packed)), 4, 5);
}

TEST(readCarmenLog, NamesFileAndLineOfWhatIsWrong) {
    const std::string good = goodLog();
    EXPECT_EQ(messageOf(good.substr(0, good.size() - 2)),
              "line 7: breaks off: the file's last line has no end");
    EXPECT_EQ(messageOf(good.substr(0, good.size() - 12) + "\n"),
              "line 7: FLASER of 5 readings has 14 fields instead of 16: cut, or wrongly counted");
    EXPECT_EQ(messageOf(replaced(good, "FLASER 5", "FLASER 4")),
              "line 6: FLASER of 4 readings has 16 fields instead of 15: cut, or wrongly counted");
    EXPECT_EQ(messageOf(replaced(good, "FLASER 5", "FLASER -5")),
              "line 6: FLASER: number of readings is \"-5\"");
    EXPECT_EQ(messageOf(replaced(good, "FLASER 5", "FLASER 99999999999999999999999")),
              "line 6: FLASER: number of readings is \"99999999999999999999999\"");
    EXPECT_EQ(messageOf(replaced(good, "FLASER 5", "FLASER 18446744073709551615")),
              "line 6: FLASER of 18446744073709551615 readings has 16 fields instead of 10: cut, "
              "or wrongly counted");
    EXPECT_EQ(messageOf(replaced(good, "1.03", "nan")),
              "line 6: FLASER: field 5 is \"nan\", not a number from 0 to 1000");
    EXPECT_EQ(messageOf(replaced(good, "1.03", "-1.03")),
              "line 6: FLASER: field 5 is \"-1.03\", not a number from 0 to 1000");
    EXPECT_EQ(messageOf(replaced(good, "1.5 2", "inf 2")),
              "line 7: FLASER: field 10 is \"inf\", not a number from -1000000 to 1000000");
    EXPECT_EQ(messageOf(replaced(good, "-0.04", "far")),
              "line 3: PARAM: field 2 is \"far\", not a number from -1000 to 1000");
    EXPECT_EQ(messageOf(replaced(good, "ODOM", "oDOM")),
              "line 4: begins with \"oDOM\", which names no CARMEN message");
    EXPECT_EQ(messageOf("FLASER\n"),
              "line 1: FLASER of 0 readings has 1 fields instead of 11: cut, or wrongly counted");
    EXPECT_EQ(messageOf("ODOM 1 2 3 0 0 0 5 h 5\n"), "holds no FLASER line; is it a CARMEN log?");
    EXPECT_EQ(messageOf(std::string(70000, 'A') + "\n"), "line 1: is longer than 65536 characters");
    EXPECT_EQ(messageOf(""), "is empty");
    EXPECT_THROW(readCarmenLog("/no/such.log"), std::runtime_error);
    EXPECT_THROW(readCarmenLog("/tmp"), std::runtime_error);
    observations::TCarmenOptions options;
    options.maxRange = std::nan("");
    EXPECT_THROW(readCarmenLog("/no/such.log", options), std::invalid_argument);
}

TEST(readCarmenLog, RefusesAPackedFileThatIsCut) {
    const CTemporaryFolder folder;
    const std::string whole = (folder / "whole.gz").string();
    packInto(whole, goodLog());
    const std::string packed = test::readFile(whole);
    for (std::size_t bytes = 3; bytes < packed.size(); bytes += 7)
        EXPECT_THROW(readCarmenLog(folder.write("cut.gz", packed.substr(0, bytes))),
                     std::runtime_error)
            << bytes;
}

/// Whatever bytes come: a log with finite numbers, or one line of error.
TEST(readCarmenLog, SurvivesMutatedFiles) {
    const CTemporaryFolder folder;
    const std::string whole = (folder / "whole.gz").string();
    packInto(whole, goodLog());
    const std::string texts[] = {goodLog(), test::readFile(whole)};
    std::mt19937 random(7);
    const std::string spice = "0123456789-+.eEnaif \n\t\rFLASER#";
    int read = 0;
    int refused = 0;
    for (int i = 0; i < 1600; ++i) {
        std::string text = texts[i % 2];
        for (std::uint32_t k = 1 + random() % 4; k > 0; --k) {
            const std::size_t at = random() % text.size();
            switch (random() % 4) {
                case 0:
                    text[at] = static_cast<char>(random());
                    break;
                case 1:
                    text[at] = spice[random() % spice.size()];
                    break;
                case 2:
                    text.erase(at, 1 + random() % 5);
                    break;
                default:
                    text.insert(at, 1, spice[random() % spice.size()]);
            }
            if (text.empty()) text = "x";
        }
        if (random() % 8 == 0) text.resize(random() % text.size());
        const std::string file = folder.write("m.log", text);
        try {
            const TCarmenLog log = readCarmenLog(file);
            ++read;
            for (const auto& entry : log.scans) {
                ASSERT_TRUE(std::isfinite(entry.odometry.norm()));
                for (std::size_t k = 0; k < entry.scan->getScanSize(); ++k)
                    ASSERT_TRUE(entry.scan->getScanRange(k) >= 0);
            }
        } catch (const std::runtime_error& error) {
            ++refused;
            const std::string message = error.what();
            ASSERT_EQ(message.find(file + ": "), 0U) << message;
            for (const char c : message) ASSERT_TRUE(c >= ' ' && c <= '~') << message;
        }
    }
    EXPECT_GT(read, 80);
    EXPECT_GT(refused, 800);
}

TEST(readCarmenLog, ReadsTheRealLogs) {
    struct TReal {
        const char* file;
        std::size_t scans, readings, backwards;
        double offset;
    };
    const TReal logs[] = {{"laser/intel.clf.bz2", 13631, 180, 631, 0},
                          {"laser/fr079.clf.bz2", 4934, 360, 0, -0.04},
                          {"laser/mit-csail.clf.bz2", 1988, 361, 0, 0}};
    for (const TReal& real : logs) {
        SALMA_NEED_DATA(file, real.file);
        const TCarmenLog log = readCarmenLog(file);
        expectWhole(log, real.scans, real.readings);
        EXPECT_EQ(log.backwards, real.backwards) << real.file;
        EXPECT_DOUBLE_EQ(log.scans.back().scan->sensorPose.x(), real.offset) << real.file;
    }
}

TEST(readCarmenLog, ReadsTheRealLogsWithPosesOfAnotherProgram) {
    struct TReal {
        const char* file;
        std::size_t scans, readings;
    };
    const TReal logs[] = {{"laser/belgioioso-corrected.log.gz", 395, 361},
                          {"laser/csail-corrected.log.gz", 406, 361},
                          {"laser/freiburg-079-corrected.log.gz", 4791, 360},
                          {"laser/infinite-corridor-corrected.log.gz", 1941, 180},
                          {"laser/intel-corrected.log.gz", 910, 180}};
    for (const TReal& real : logs) {
        SALMA_NEED_DATA(file, real.file);
        expectWhole(readCarmenLog(file), real.scans, real.readings);
    }
}
