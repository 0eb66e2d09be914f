// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/observations/CLogWriter.h>

#include <opencv2/core.hpp>

#include "CTemporaryFolder.h"
#include "examples.h"
#include "logs.h"

using namespace salma;
using mrpt::poses::CPose2D;
using observations::CObservationSalientLandmarks;
using observations::readLog;
using observations::TLog;
using test::CTemporaryFolder;

namespace {

std::string observationLog(const CTemporaryFolder& folder) {
    return folder.write(
        "log.rawlog",
        test::bytesOf({test::odometryAt(0, CPose2D(0, 0, 0)), test::scanAt(0.2),
                       test::pictureAt(0.5, "a.jpg"), test::scanAt(0.7),
                       test::pictureAt(0.9, "b.jpg"), test::odometryAt(1, CPose2D(1, 0, 0))}));
}

std::string actionLog(const CTemporaryFolder& folder) {
    return folder.write("log.rawlog",
                        test::packed(test::bytesOf(
                            {test::motion(CPose2D(1, 0, 0.1)),
                             test::frame({test::scanAt(0.4), test::pictureAt(0.5, "a.jpg")}),
                             test::motion(CPose2D(2, 0, 0)),
                             test::frame({test::scanAt(0.8), test::pictureAt(0.9, "b.jpg")})})));
}

/// Expects the same steps with the same observations, by class, label and stamp.
void expectSame(const TLog& a, const TLog& b) {
    EXPECT_EQ(a.actionFormat, b.actionFormat);
    ASSERT_EQ(a.steps.size(), b.steps.size());
    for (std::size_t i = 0; i < a.steps.size(); ++i) {
        EXPECT_EQ(a.steps[i].time, b.steps[i].time);
        EXPECT_NEAR(a.steps[i].odometry.distanceTo(b.steps[i].odometry), 0, 1e-12);
        EXPECT_EQ(a.steps[i].increment.has_value(), b.steps[i].increment.has_value());
        ASSERT_EQ(a.steps[i].observations.size(), b.steps[i].observations.size()) << i;
        for (std::size_t k = 0; k < a.steps[i].observations.size(); ++k) {
            const auto& left = *a.steps[i].observations[k];
            const auto& right = *b.steps[i].observations[k];
            EXPECT_STREQ(left.GetRuntimeClass()->className, right.GetRuntimeClass()->className);
            EXPECT_EQ(left.sensorLabel, right.sensorLabel);
            EXPECT_EQ(left.timestamp, right.timestamp);
        }
    }
}

/// Stamps of the records in each step, in tenths of a second after kStart.
std::vector<std::vector<long>> recordTimes(const TLog& log) {
    std::vector<std::vector<long>> result;
    for (const auto& step : log.steps) {
        auto& row = result.emplace_back();
        for (const auto& observation : step.observations)
            if (std::dynamic_pointer_cast<CObservationSalientLandmarks>(observation))
                row.push_back(std::lround(
                    10 * (mrpt::Clock::toDouble(observation->timestamp) - test::kStart)));
    }
    return result;
}

}  // namespace

TEST(CLogWriter, CompanionAndEmbeddedFileOfAnObservationLogReadAlike) {
    const CTemporaryFolder folder;
    const TLog log = readLog(observationLog(folder));
    const observations::TSalientRecords records{test::recordAt(0.9), test::recordAt(0.5)};
    const std::string whole = (folder / "whole.rawlog").string();
    saveEmbedded(log, records, whole);
    saveCompanion(log, records, observations::companionOf(log.file));
    const TLog embedded = readLog(whole);
    const TLog merged = readLog(log.file);
    EXPECT_FALSE(embedded.actionFormat);
    EXPECT_EQ(recordTimes(merged), (std::vector<std::vector<long>>{{}, {}, {5}, {}, {}, {9}}));
    expectSame(embedded, merged);
}

TEST(CLogWriter, CompanionAndEmbeddedFileOfAnActionLogReadAlike) {
    const CTemporaryFolder folder;
    const TLog log = readLog(actionLog(folder));
    const observations::TSalientRecords records{test::recordAt(0.5), test::recordAt(0.9)};
    const std::string whole = (folder / "whole.rawlog").string();
    saveEmbedded(log, records, whole);
    saveCompanion(log, records, observations::companionOf(log.file));
    const TLog embedded = readLog(whole);
    const TLog merged = readLog(log.file);
    EXPECT_TRUE(embedded.actionFormat);
    EXPECT_EQ(recordTimes(merged), (std::vector<std::vector<long>>{{5}, {9}}));
    expectSame(embedded, merged);
}

TEST(CLogWriter, ANewCompanionKeepsTheHeadAndReplacesTheRecordsOfTheOldOne) {
    const CTemporaryFolder folder;
    const std::string file = observationLog(folder);
    folder.write("log.salient.rawlog",
                 test::bytesOf({test::headAt(0.4, 0.25), test::recordAt(0.45)}));
    const TLog log = readLog(file);
    ASSERT_FALSE(log.companionFile.empty());
    saveCompanion(log, {test::recordAt(0.5)}, log.companionFile);
    const TLog again = readLog(file);
    EXPECT_EQ(recordTimes(again), (std::vector<std::vector<long>>{{}, {}, {5}, {}, {}}));
    EXPECT_NEAR(again.panTilt.cameraPose(test::kStart + 0.4, 0)->yaw(), 0.25, 1e-12);
    // The same holds for one file of all.
    const std::string whole = (folder / "whole.rawlog").string();
    saveEmbedded(again, {test::recordAt(0.9)}, whole);
    const TLog embedded = readLog(whole);
    EXPECT_EQ(recordTimes(embedded), (std::vector<std::vector<long>>{{}, {}, {}, {}, {9}}));
    EXPECT_FALSE(embedded.panTilt.empty());
}

TEST(CLogWriter, WhatIsWholeOfATruncatedLogIsWritten) {
    const CTemporaryFolder folder;
    const std::string bytes = test::readFile(observationLog(folder));
    const auto cut = folder.write("cut.rawlog", bytes.substr(0, bytes.size() - 3));
    observations::TLogReaderOptions options;
    options.acceptTruncated = true;
    const TLog log = readLog(cut, options);
    const std::string whole = (folder / "whole.rawlog").string();
    saveEmbedded(log, {test::recordAt(0.5)}, whole);
    EXPECT_EQ(readLog(whole).steps.size(), 5U);
}

TEST(CLogWriter, SameRecordsSameBytes) {
    const CTemporaryFolder folder;
    const TLog log = readLog(actionLog(folder));
    saveEmbedded(log, {test::exampleRecord()}, (folder / "a.rawlog").string());
    saveEmbedded(log, {test::exampleRecord()}, (folder / "b.rawlog").string());
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), test::readFile(folder / "b.rawlog"));
}

TEST(CLogWriter, AnUnwritablePlaceIsNamedAndNothingIsLeft) {
    const CTemporaryFolder folder;
    const TLog log = readLog(observationLog(folder));
    const std::string file = (folder / "no/such/folder.rawlog").string();
    try {
        saveCompanion(log, {test::recordAt(0.5)}, file);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).find(file + ": cannot be written"), 0U);
    }
    auto colour = test::recordAt(0.5);
    colour->landmarks[0].picture =
        mrpt::img::CImage(cv::Mat(3, 3, CV_8UC3, cv::Scalar(0)), mrpt::img::DEEP_COPY);
    EXPECT_THROW(saveCompanion(log, {colour}, (folder / "c.rawlog").string()), std::exception);
    EXPECT_THROW(saveCompanion(log, {nullptr}, (folder / "c.rawlog").string()), std::exception);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        files += entry.path().filename() == "log.rawlog" ? 0 : 1;
    EXPECT_EQ(files, 0U);
}
