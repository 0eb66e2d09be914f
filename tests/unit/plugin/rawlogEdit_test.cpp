// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <messages.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/CLogWriter.h>

#include <cstdlib>
#include <sstream>

#include "CProcess.h"
#include "CTemporaryFolder.h"
#include "examples.h"
#include "logs.h"
#include "stockProgram.h"

using namespace salma;
using mrpt::poses::CPose2D;
using test::CTemporaryFolder;

namespace {

using salma::test::contains;

/// The stock program rawlog-edit of MRPT on a small log that holds records of this project.
class RawlogEdit : public testing::Test {
 protected:
    void SetUp() override {
        if (std::system("command -v rawlog-edit >/dev/null") != 0)
            GTEST_SKIP() << "SKIPPED, rawlog-edit of package mrpt-apps is not here";
    }

    std::string observationLog() const {
        return m_folder.write(
            "obs.rawlog",
            test::packed(test::bytesOf({test::odometryAt(0, CPose2D()), test::scanAt(0.125),
                                        test::exampleRecord(), test::recordAt(0.5),
                                        test::examplePanTilt(), test::scanAt(1)})));
    }

    std::string actionLog() const {
        return m_folder.write(
            "sf.rawlog",
            test::packed(test::bytesOf(
                {test::motion(CPose2D(1, 0, 0)),
                 test::frame({test::scanAt(0), test::exampleRecord()}),
                 test::motion(CPose2D(1, 0, 0)),
                 test::frame({test::scanAt(1), test::recordAt(1), test::examplePanTilt()})})));
    }

    static std::string run(const std::vector<std::string>& arguments) {
        auto command = test::stockProgram("rawlog-edit");
        command.insert(command.end(), arguments.begin(), arguments.end());
        const auto result = test::runProcess(command);
        EXPECT_EQ(result.exitCode, 0) << result.output;
        return result.output;
    }

    static std::string runWithPlugin(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"-p", SALMA_PLUGIN});
        const std::string output = run(arguments);
        // It goes on when a plug-in or a record cannot be read, and only says so.
        EXPECT_EQ(output.find("not registered"), std::string::npos) << output;
        return output;
    }

    CTemporaryFolder m_folder;
};

/// The number behind `key` and a colon or slash in the output of --info.
int numberBehind(const std::string& output, const std::string& key) {
    const std::size_t at = output.find(key);
    if (at == std::string::npos) return -1;
    return std::atoi(output.c_str() + output.find_first_of(":/", at + key.size()) + 1);
}

}  // namespace

TEST_F(RawlogEdit, InfoCountsEveryRecordOfAnObservationLog) {
    const auto output = runWithPlugin({"-i", observationLog(), "--info"});
    EXPECT_EQ(numberBehind(output, "Overall number of objects"), 6) << output;
    EXPECT_EQ(numberBehind(output, "SALIENT "), 2) << output;
    EXPECT_TRUE(contains(output, "HEAD, LASER, ODOMETRY, SALIENT")) << output;
}

TEST_F(RawlogEdit, InfoReadsRecordsInSensoryFrames) {
    const auto output = runWithPlugin({"-i", actionLog(), "--info"});
    EXPECT_EQ(numberBehind(output, "Overall number of objects"), 4) << output;
    EXPECT_TRUE(contains(output, "HEAD, LASER, SALIENT")) << output;
}

TEST_F(RawlogEdit, DescribeShowsOurText) {
    for (const auto& file : {observationLog(), actionLog()}) {
        const auto output = runWithPlugin({"-i", file, "--describe"});
        EXPECT_TRUE(contains(output, "Salient landmarks: 2")) << output;
        EXPECT_TRUE(contains(output, "Landmark 0: 0.900 x 0.600 m")) << output;
        EXPECT_TRUE(contains(output, "Pan: 22.918 deg")) << output;
    }
}

TEST_F(RawlogEdit, KeepLabelLeavesOurRecordsWhole) {
    const std::string kept = (m_folder / "kept.rawlog").string();
    runWithPlugin({"-i", observationLog(), "--keep-label", "SALIENT,HEAD", "-o", kept});
    const auto log = observations::readLog(kept);
    EXPECT_EQ(log.counts.size(), 2U);
    ASSERT_EQ(log.steps.size(), 2U);
    const auto record = std::dynamic_pointer_cast<observations::CObservationSalientLandmarks>(
        log.steps[0].observations.at(0));
    ASSERT_TRUE(record);
    test::expectExample(*record);
    EXPECT_FALSE(log.panTilt.empty());
}

TEST_F(RawlogEdit, RemoveLabelLeavesTheRest) {
    const std::string rest = (m_folder / "rest.rawlog").string();
    runWithPlugin({"-i", observationLog(), "--remove-label", "SALIENT", "-o", rest});
    const auto log = observations::readLog(rest);
    EXPECT_EQ(log.counts.at("mrpt::obs::CObservation2DRangeScan"), 2U);
    EXPECT_EQ(log.counts.count("salma::observations::CObservationSalientLandmarks"), 0U);
    EXPECT_FALSE(log.panTilt.empty());
}

TEST_F(RawlogEdit, ExportTxtWritesOneRowPerRecord) {
    observationLog();
    // rawlog-edit forgets the slash behind a folder, so the log must be named without one.
    const std::string here = m_folder.path().string();
    auto command = test::stockProgram("rawlog-edit", {"-C", here});
    command.insert(command.end(), {"-p", SALMA_PLUGIN, "-i", "obs.rawlog", "--export-txt"});
    const auto result = test::runProcess(command);
    EXPECT_EQ(result.exitCode, 0) << result.output;
    std::istringstream rows(test::readFile(m_folder / "obs_SALIENT.txt"));
    std::string header;
    std::string first;
    std::string second;
    std::getline(rows, header);
    std::getline(rows, first);
    std::getline(rows, second);
    EXPECT_TRUE(contains(header, "Time landmarks regions keypoints camera_x_m")) << header;
    EXPECT_EQ(first.find("1000000000.250000 2 2 1 0.100000 0.200000 1.100000 "), 0U) << first;
    EXPECT_TRUE(contains(first, " WCJ CAMERA_1.jpg"));
    EXPECT_EQ(second.find("1000000000.500000 1 0 0 "), 0U) << second;
    EXPECT_TRUE(contains(test::readFile(m_folder / "obs_HEAD.txt"), "22.918312 -5.729578 1.5"));
}

TEST_F(RawlogEdit, WithoutThePluginACompanionKeepsTheMainLogWhole) {
    const std::string file = m_folder.write(
        "main.rawlog",
        test::packed(test::bytesOf({test::odometryAt(0, CPose2D()), test::scanAt(0.1),
                                    test::scanAt(0.6), test::odometryAt(1, CPose2D(1, 0, 0))})));
    const auto log = observations::readLog(file);
    const observations::TSalientRecords records{test::recordAt(0.2), test::recordAt(0.7)};
    observations::saveCompanion(log, records, observations::companionOf(file));
    const std::string embedded = (m_folder / "embedded.rawlog").string();
    observations::saveEmbedded(log, records, embedded);

    const auto whole = run({"-i", file, "--info"});
    EXPECT_EQ(numberBehind(whole, "Overall number of objects"), 4) << whole;
    EXPECT_FALSE(contains(whole, "not registered"));
    // This is why companions are the default: one foreign record hides all that follow it.
    const auto cut = run({"-i", embedded, "--info"});
    EXPECT_EQ(numberBehind(cut, "Overall number of objects"), 2) << cut;
    EXPECT_TRUE(contains(cut, "not registered"));
    // With the plug-in both are whole.
    const auto companion = runWithPlugin({"-i", observations::companionOf(file), "--info"});
    EXPECT_EQ(numberBehind(companion, "Overall number of objects"), 2) << companion;
    const auto all = runWithPlugin({"-i", embedded, "--info"});
    EXPECT_EQ(numberBehind(all, "Overall number of objects"), 6) << all;
}
