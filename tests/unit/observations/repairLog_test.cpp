// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <messages.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/serialization/CArchive.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/repairLog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <random>

#include "CTemporaryFolder.h"

namespace fs = std::filesystem;

namespace salma::observations {
namespace {

using salma::test::contains;

constexpr double kStart = 1.6e9;

/// Serialised objects, one string each.
class CObjects : public mrpt::serialization::CArchive {
 public:
    std::string text;

 protected:
    std::size_t write(const void* bytes, std::size_t count) override {
        text.append(static_cast<const char*>(bytes), count);
        return count;
    }
    std::size_t read(void*, std::size_t) override { throw std::logic_error("not read"); }
    std::string getArchiveDescription() const override { return "objects"; }
};

std::string odometry(int number) {
    mrpt::obs::CObservationOdometry reading;
    reading.timestamp = mrpt::Clock::fromDouble(kStart + number);
    reading.odometry = mrpt::poses::CPose2D(number, 0, 0);
    reading.sensorLabel = "ODO";
    CObjects archive;
    archive << reading;
    return archive.text;
}

std::string member(const std::string& data) {
    z_stream stream{};
    deflateInit2(&stream, 1, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&stream, data.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
    stream.avail_in = static_cast<uInt>(data.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

/// `members` gzip members of three odometry readings each.
std::string log(int members) {
    std::string text;
    for (int m = 0; m < members; ++m)
        text += member(odometry(3 * m) + odometry(3 * m + 1) + odometry(3 * m + 2));
    return text;
}

class RepairLog : public testing::Test {
 protected:
    std::string write(const std::string& content) const {
        return m_folder.write("x.rawlog", content);
    }
    std::string failure(const std::string& file) const {
        try {
            repairLog(file, (m_folder / "out.rawlog").string());
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }
    test::CTemporaryFolder m_folder;
};

}  // namespace

TEST_F(RepairLog, AWholeLogOfSeveralMembersIsReadWholeAndLeftAlone) {
    const std::string file = write(log(4));
    const auto read = readLog(file);
    EXPECT_FALSE(read.truncated);
    EXPECT_EQ(read.counts.at("mrpt::obs::CObservationOdometry"), 12U);
    const TRepair repair = repairLog(file, file);
    EXPECT_TRUE(repair.whole);
    EXPECT_EQ(repair.records, 12U);
    EXPECT_EQ(repair.bytesLost, 0U);
    EXPECT_EQ(repair.lastGoodTime, kStart + 11);
    EXPECT_EQ(test::readFile(file), log(4));
    EXPECT_FALSE(fs::exists(file + ".broken"));
}

TEST_F(RepairLog, AFileThatEndsInsideAMemberKeepsItsWholeObjects) {
    const std::string whole = log(4);
    const std::string broken = whole.substr(0, log(3).size() + member(odometry(9)).size() / 2);
    const std::string file = write(broken);
    EXPECT_THROW(readLog(file), std::runtime_error);
    const TRepair repair = repairLog(file, file);
    EXPECT_FALSE(repair.whole);
    EXPECT_EQ(repair.cause, "it breaks off");
    EXPECT_GE(repair.records, 9U);
    EXPECT_LT(repair.records, 12U);
    EXPECT_EQ(test::readFile(file + ".broken"), broken);
    const auto read = readLog(file);
    EXPECT_EQ(read.counts.at("mrpt::obs::CObservationOdometry"), repair.records);
    EXPECT_TRUE(repairLog(file, file).whole);
}

TEST_F(RepairLog, AFileThatEndsInsideAnObjectSaysWhatIsLost) {
    const std::string partial = odometry(2).substr(0, 20);
    for (const bool packed : {false, true}) {
        const std::string content = odometry(0) + odometry(1) + partial;
        const std::string file = write(packed ? member(content) : content);
        const std::string target = (m_folder / "mended.rawlog").string();
        const TRepair repair = repairLog(file, target);
        EXPECT_FALSE(repair.whole);
        EXPECT_EQ(repair.records, 2U);
        EXPECT_EQ(repair.bytesLost, 20U);
        EXPECT_EQ(repair.bytesKept, odometry(0).size() + odometry(1).size());
        EXPECT_EQ(repair.lastGoodTime, kStart + 1);
        EXPECT_FALSE(repair.secondsLost);  // it was not written in the year 2020
        EXPECT_EQ(readLog(target).counts.at("mrpt::obs::CObservationOdometry"), 2U);
    }
}

TEST_F(RepairLog, TheTimeFromTheLastRecordToTheLastWriteIsTold) {
    const std::string file = write(odometry(0) + odometry(1) + "\x80");
    const timespec times[2] = {{1600000003, 500000000}, {1600000003, 500000000}};
    ASSERT_EQ(utimensat(AT_FDCWD, file.c_str(), times, 0), 0);
    const TRepair repair = repairLog(file, (m_folder / "out.rawlog").string());
    ASSERT_TRUE(repair.secondsLost);
    EXPECT_NEAR(*repair.secondsLost, 2.5, 1e-6);
}

TEST_F(RepairLog, ZerosAfterAPowerCutEndTheLogBeforeThem) {
    std::string content = log(4);
    const std::size_t good = log(3).size();
    std::fill(content.begin() + static_cast<std::ptrdiff_t>(good) + 12, content.end(), '\0');
    const TRepair repair = repairLog(write(content), (m_folder / "out.rawlog").string());
    EXPECT_FALSE(repair.whole);
    EXPECT_TRUE(contains(repair.cause, "is damaged")) << repair.cause;
    EXPECT_EQ(repair.records, 9U);
    EXPECT_GT(repair.packedBytesLost, 0U);
}

TEST_F(RepairLog, WhatCannotBeRepairedIsSaid) {
    EXPECT_TRUE(contains(failure((m_folder / "none.rawlog").string()), "no such file"));
    EXPECT_TRUE(contains(failure(write("")), "is empty"));
    EXPECT_TRUE(contains(failure(write("some text, not a log")), "is not a rawlog"));
    EXPECT_TRUE(contains(failure(write(odometry(0).substr(0, 30))), "holds no whole record"));
    std::string foreign = odometry(1);
    const std::size_t at = foreign.find("Odometry");
    foreign.replace(at, 8, "Teleport");
    EXPECT_TRUE(contains(failure(write(odometry(0) + foreign)), "which is not registered"));
    EXPECT_FALSE(fs::exists(m_folder / "out.rawlog"));
}

TEST_F(RepairLog, AnEarlierOriginalIsNotReplaced) {
    const std::string file = write(odometry(0) + "\x80");
    m_folder.write("x.rawlog.broken", "precious");
    EXPECT_THROW(repairLog(file, file), std::runtime_error);
    EXPECT_EQ(test::readFile(file), odometry(0) + "\x80");
    EXPECT_EQ(test::readFile(file + ".broken"), "precious");
}

TEST_F(RepairLog, ALogThatIsBeingWrittenIsNotTouched) {
    const std::string file = write(odometry(0) + "\x80");
    const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(flock(descriptor, LOCK_EX), 0);
    EXPECT_TRUE(contains(failure(file), "is in use"));
    close(descriptor);
    EXPECT_EQ(failure(file), "");
}

TEST_F(RepairLog, DamageAtRandomPlacesGivesAReadableLogOrOneLine) {
    std::mt19937 random(7);
    const std::string whole = log(5), plain = odometry(0) + odometry(1) + odometry(2);
    int repaired = 0, refused = 0;
    for (int i = 0; i < 200; ++i) {
        std::string content = i % 4 == 3 ? plain : whole;
        const auto place = [&] {
            return std::uniform_int_distribution<std::size_t>(0, content.size() - 1)(random);
        };
        if (i % 2 == 0) content.resize(place());
        if (i % 4 != 0 && !content.empty())
            for (int n = i % 3; n >= 0; --n) content[place()] = static_cast<char>(random());
        const std::string file = write(content), target = (m_folder / "out.rawlog").string();
        fs::remove(target);
        try {
            const TRepair repair = repairLog(file, target);
            EXPECT_NE(repair.whole, fs::exists(target));
            if (repair.whole) continue;
            EXPECT_TRUE(repairLog(target, target).whole) << i;
            ++repaired;
        } catch (const std::runtime_error& error) {
            EXPECT_FALSE(fs::exists(target)) << i;
            EXPECT_FALSE(contains(error.what(), "\n")) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(repaired, 50);
    EXPECT_GT(refused, 10);
}

}  // namespace salma::observations
