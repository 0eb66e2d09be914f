// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/calibration/TRangeScan.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace salma::calibration {
namespace {

const std::string kGood =
    "1465679400 -1.5 0.5 1.0 3 5 1.25, 2.5,inf, nan, 3\r\n"
    "1465679410 -1.5 0.5 0.5 0 5 0 - 1 2 3\n";

/// The message of the error; "" if there is none.
std::string messageOf(const std::string& file, std::size_t first = 1, std::size_t count = 1) {
    try {
        readScans(file, first, count);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

TEST(ReadScans, ReadsRangesAndWhatDidNotComeBack) {
    const test::CTemporaryFolder folder;
    const auto scans = readScans(folder.write("scans.txt", kGood), 1, 2);
    ASSERT_EQ(scans.size(), 2u);
    EXPECT_EQ(scans[0].time, 1465679400);
    EXPECT_EQ(scans[0].ranges.size(), 5u);
    EXPECT_EQ(scans[0].ranges[1], 2.5);
    EXPECT_TRUE(std::isnan(scans[0].ranges[2]));
    EXPECT_TRUE(std::isnan(scans[0].ranges[3]));
    EXPECT_DOUBLE_EQ(scans[0].direction(4), 0.5);
    EXPECT_TRUE(std::isnan(scans[1].ranges[0])) << "0 m";
    EXPECT_TRUE(std::isnan(scans[1].ranges[1])) << "-";
    EXPECT_EQ(readScans(folder.write("scans.txt", kGood), 2, 1)[0].time, 1465679410);
}

TEST(ReadScans, LooksOnlyAtTheLinesThatAreAskedFor) {
    const test::CTemporaryFolder folder;
    const std::string file = folder.write("scans.txt", "no scan\n" + kGood + "nor this\n");
    EXPECT_EQ(readScans(file, 2, 2).size(), 2u);
    EXPECT_EQ(messageOf(file, 3, 2), file + ":4: 'nor' is no number, where stamp stands");
}

TEST(ReadScans, NamesFileLineAndValueOfAMistake) {
    const test::CTemporaryFolder folder;
    const auto message = [&](const std::string& text) {
        const std::string file = folder.write("scans.txt", text);
        const std::string all = messageOf(file);
        EXPECT_EQ(all.compare(0, file.size(), file), 0) << all;
        return all.substr(std::min(all.size(), file.size()));
    };
    EXPECT_EQ(message(""), ": has 0 lines, but scans 1 to 1 are needed");
    EXPECT_EQ(message("\n"), ":1: breaks off before stamp");
    EXPECT_EQ(message("1 -1.5 0.5"), ":1: breaks off before end");
    EXPECT_EQ(message("1 -1.5 0.5 1 3 5 1 2"), ":1: breaks off after 2 of 5 ranges");
    EXPECT_EQ(message("1 -1.5 0.5 1 3 5 1 2 3 4 5 6"),
              ":1: '6' follows the 5 ranges that the line announces");
    EXPECT_EQ(message("1 -1.5 0.5 1 3 5 1 2 x 4 5"), ":1: 'x' is no number, where range 3 stands");
    EXPECT_EQ(message("1 -1.5 0.5 1 3 5 1 2 -3 4 5"), ":1: '-3' is no range");
    EXPECT_EQ(message("1 nan 0.5 1 3 5 1 2 3 4 5"), ":1: 'nan' is no start");
    EXPECT_NE(message("1 -1.5 0.5 1 3 5.5 1 2 3 4 5").find("is no count"), std::string::npos);
    EXPECT_NE(message("1 -1.5 0.5 1 3 1e9 1 2 3 4 5").find("is no count"), std::string::npos);
    EXPECT_NE(message("1 -1.5 0 1 3 5 1 2 3 4 5").find("a step of"), std::string::npos);
    EXPECT_NE(message("1 -1.5 0.5 9 3 5 1 2 3 4 5").find("steps for 5 ranges"), std::string::npos);
    EXPECT_NE(messageOf((folder / "none.txt").string()).find("is missing"), std::string::npos);
    EXPECT_NE(messageOf(folder.path().string()).find("not a file"), std::string::npos);
}

TEST(ReadScans, EitherReadsOrNamesTheLineOfDamagedText) {
    const test::CTemporaryFolder folder;
    std::mt19937 random(11);
    int refused = 0;
    for (int i = 0; i < 1000; ++i) {
        std::string text = kGood;
        const int changes = 1 + static_cast<int>(random() % 4);
        for (int k = 0; k < changes && !text.empty(); ++k) {
            const std::size_t at = random() % text.size();
            switch (random() % 4) {
                case 0:
                    text[at] = static_cast<char>(random() % 256);
                    break;
                case 1:
                    text.erase(at, 1 + random() % 8);
                    break;
                case 2:
                    text.insert(at, text.substr(random() % text.size(), random() % 12));
                    break;
                default:
                    text.resize(at);
            }
        }
        const std::string file = folder.write("scans.txt", text);
        try {
            for (const auto& scan : readScans(file, 1, 2)) {
                ASSERT_GE(scan.ranges.size(), 1u);
                ASSERT_TRUE(std::isfinite(scan.start) && std::isfinite(scan.step));
                for (const double r : scan.ranges) ASSERT_TRUE(std::isnan(r) || r > 0);
            }
        } catch (const std::runtime_error& e) {
            ++refused;
            ASSERT_EQ(std::string(e.what()).compare(0, file.size(), file), 0) << e.what();
        }
    }
    EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace salma::calibration
