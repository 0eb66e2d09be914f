// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <salma/observations/CLogReader.h>

#include "CTemporaryFolder.h"
#include "examples.h"
#include "logs.h"

using namespace salma;
using mrpt::poses::CPose2D;
using observations::readLog;
using test::CTemporaryFolder;

namespace {

std::vector<double> times(const observations::TLog& log) {
    std::vector<double> result;
    for (const auto& step : log.steps) result.push_back(step.time - test::kStart);
    return result;
}

}  // namespace

TEST(CLogReader, NamesTheCompanionBesideTheLog) {
    EXPECT_EQ(observations::companionOf("/a/b.c/X.rawlog"), "/a/b.c/X.salient.rawlog");
    EXPECT_EQ(observations::companionOf("X"), "X.salient.rawlog");
}

TEST(CLogReader, ObservationsAreStepsInOrderOfTimeWithOdometryBetweenItsRecords) {
    const CTemporaryFolder folder;
    const auto file = folder.write(
        "log.rawlog",
        test::packed(test::bytesOf({test::odometryAt(0, CPose2D(0, 0, 0)),
                                    test::scanAt(0.75),  // overtook the next two on its way
                                    test::scanAt(0.25), test::odometryAt(1, CPose2D(4, 2, 0.4))})));
    const auto log = readLog(file);
    EXPECT_FALSE(log.actionFormat);
    EXPECT_TRUE(log.hasOdometry);
    EXPECT_EQ(times(log), (std::vector<double>{0.25, 0.75}));
    EXPECT_NEAR(log.steps[0].odometry.x(), 1, 1e-9);
    EXPECT_NEAR(log.steps[1].odometry.y(), 1.5, 1e-9);
    EXPECT_NEAR(log.steps[1].odometry.phi(), 0.3, 1e-9);
    EXPECT_FALSE(log.steps[0].increment);
    EXPECT_EQ(log.counts.at("mrpt::obs::CObservation2DRangeScan"), 2U);
    EXPECT_EQ(log.counts.at("mrpt::obs::CObservationOdometry"), 2U);
    EXPECT_EQ(log.imagesFolder, (folder / "log_Images").string());
    EXPECT_EQ(log.outOfOrder, 0U);
    EXPECT_TRUE(log.dropped.empty());
}

TEST(CLogReader, PlainFilesAreReadAsGzipFiles) {
    const CTemporaryFolder folder;
    const auto file = folder.write("log.rawlog", test::bytesOf({test::scanAt(1)}));
    EXPECT_EQ(times(readLog(file)), std::vector<double>{1});
}

TEST(CLogReader, EqualStampsKeepTheOrderOfTheFile) {
    const CTemporaryFolder folder;
    test::TObjects objects;
    for (int i = 0; i < 20; ++i) objects.push_back(test::scanAt(1, "L" + std::to_string(i)));
    const auto log = readLog(folder.write("log.rawlog", test::bytesOf(objects)));
    ASSERT_EQ(log.steps.size(), 20U);
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(log.steps[i].observations[0]->sensorLabel, "L" + std::to_string(i));
}

TEST(CLogReader, OdometryThatGoesBackInTimeIsSortedAndCounted) {
    const CTemporaryFolder folder;
    const auto file = folder.write(
        "log.rawlog",
        test::bytesOf({test::odometryAt(0, CPose2D(0, 0, 0)), test::odometryAt(2, CPose2D(2, 0, 0)),
                       test::odometryAt(1, CPose2D(1, 0, 0)), test::scanAt(0.5),
                       test::scanAt(1.5)}));
    const auto log = readLog(file);
    EXPECT_EQ(log.outOfOrder, 1U);
    EXPECT_NEAR(log.steps[0].odometry.x(), 0.5, 1e-6);
    EXPECT_NEAR(log.steps[1].odometry.x(), 1.5, 1e-6);
}

TEST(CLogReader, OfTwoOdometrySensorsTheFirstCounts) {
    const CTemporaryFolder folder;
    const auto other = test::odometryAt(0.5, CPose2D(77, 0, 0));
    other->sensorLabel = "VISUAL";
    const auto log = readLog(folder.write(
        "log.rawlog", test::bytesOf({test::odometryAt(0, CPose2D(0, 0, 0)), other,
                                     test::odometryAt(1, CPose2D(1, 0, 0)), test::scanAt(0.5)})));
    EXPECT_NEAR(log.steps.at(0).odometry.x(), 0.5, 1e-6);
    EXPECT_EQ(log.dropped.at("odometry of a further sensor: VISUAL"), 1U);
}

TEST(CLogReader, ObservationsWithoutStampAreDroppedAndCounted) {
    const CTemporaryFolder folder;
    const auto scan = test::scanAt(0);
    scan->timestamp = INVALID_TIMESTAMP;
    const auto log = readLog(folder.write("log.rawlog", test::bytesOf({scan, test::scanAt(1)})));
    EXPECT_EQ(times(log), std::vector<double>{1});
    EXPECT_EQ(log.dropped.at("without a stamp"), 1U);
}

TEST(CLogReader, MotionsOfActionsAddUp) {
    const CTemporaryFolder folder;
    const auto file = folder.write(
        "log.rawlog", test::packed(test::bytesOf(
                          {test::motion(CPose2D(1, 0, M_PI / 2)), test::frame({test::scanAt(0.1)}),
                           test::motion(CPose2D(2, 0, 0)),
                           test::frame({test::scanAt(0.2), test::scanAt(0.21, "B")})})));
    const auto log = readLog(file);
    EXPECT_TRUE(log.actionFormat);
    EXPECT_TRUE(log.hasOdometry);
    ASSERT_EQ(log.steps.size(), 2U);
    EXPECT_EQ(log.steps[1].observations.size(), 2U);
    // One metre ahead, a quarter turn to the left, then two metres ahead.
    EXPECT_NEAR(log.steps[0].odometry.x(), 1, 1e-12);
    EXPECT_NEAR(log.steps[1].odometry.x(), 1, 1e-12);
    EXPECT_NEAR(log.steps[1].odometry.y(), 2, 1e-12);
    ASSERT_TRUE(log.steps[1].increment);
    EXPECT_NEAR(log.steps[1].increment->mean.x(), 2, 1e-12);
    // MRPT's Gaussian model, straight ahead: (minStdXY + a1 d)^2 on x.
    EXPECT_NEAR(log.steps[1].increment->cov(0, 0), std::pow(0.01 + 0.01 * 2, 2), 1e-8);
    EXPECT_NEAR(log.odometry.at(test::kStart + 0.15, 0)->y(), 1, 1e-4);
}

TEST(CLogReader, SeveralActionsBeforeAFrameAreOneMotion) {
    const CTemporaryFolder folder;
    const auto log =
        readLog(folder.write("log.rawlog", test::bytesOf({test::motion(CPose2D(1, 0, M_PI / 2)),
                                                          test::motion(CPose2D(3, 0, 0)),
                                                          test::frame({test::scanAt(0)})})));
    ASSERT_EQ(log.steps.size(), 1U);
    EXPECT_NEAR(log.steps[0].increment->mean.y(), 3, 1e-12);
    EXPECT_NEAR(log.steps[0].odometry.y(), 3, 1e-12);
}

TEST(CLogReader, MotionsIn3DAreSeenFromAbove) {
    const CTemporaryFolder folder;
    const auto log = readLog(folder.write(
        "log.rawlog", test::bytesOf({test::motion3D(mrpt::poses::CPose3D(1, 2, 9, 0.5, 0, 0), 0.01),
                                     test::frame({test::scanAt(0)})})));
    ASSERT_TRUE(log.steps.at(0).increment);
    const auto& increment = *log.steps[0].increment;
    EXPECT_NEAR(increment.mean.x(), 1, 1e-9);
    EXPECT_NEAR(increment.mean.y(), 2, 1e-9);
    EXPECT_NEAR(increment.mean.phi(), 0.5, 1e-9);
    EXPECT_NEAR(increment.cov(0, 0), 0.01, 1e-9);
    EXPECT_NEAR(increment.cov(2, 2), 0.01, 1e-9);
    ASSERT_TRUE(log.steps[0].spatialIncrement);
    EXPECT_NEAR(log.steps[0].spatialIncrement->mean.z(), 9, 1e-9);
}

TEST(CLogReader, MotionsIn3DBeforeOneFrameAddUpInSpaceToo) {
    const CTemporaryFolder folder;
    const mrpt::poses::CPose3D step(1, 0, 0.5, 0.1, 0.2, 0);
    const auto log = readLog(folder.write(
        "log.rawlog", test::bytesOf({test::motion3D(step, 0.01), test::motion3D(step, 0.01),
                                     test::frame({test::scanAt(0)})})));
    ASSERT_TRUE(log.steps.at(0).spatialIncrement);
    EXPECT_NEAR(log.steps[0].spatialIncrement->mean.z(), (step + step).z(), 1e-9);
}

TEST(CLogReader, MotionsOfThrunsModelHaveTheCovarianceOfItsParticles) {
    const CTemporaryFolder folder;
    const CPose2D step(0.4, 0.15, 0.3);
    const auto file = folder.write(
        "log.rawlog", test::bytesOf({test::thrunMotion(step), test::frame({test::scanAt(0)})}));
    const auto log = readLog(file);
    const auto& increment = *log.steps.at(0).increment;
    EXPECT_NEAR(increment.mean.distanceTo(step), 0, 1e-12);
    const auto sampled = test::thrunCovariance(step, 40'000);
    for (int i = 0; i < 3; ++i) {
        const double sigma = std::sqrt(sampled(i, i));
        EXPECT_NEAR(std::sqrt(increment.cov(i, i)), sigma, 0.03 * sigma) << i;
    }
    // The same file gives the same numbers.
    EXPECT_EQ(readLog(file).steps[0].increment->cov, increment.cov);
}

TEST(CLogReader, OdometryRecordsInFramesServeWhereActionsStateNoMotion) {
    const CTemporaryFolder folder;
    const auto log = readLog(folder.write(
        "log.rawlog",
        test::bytesOf({test::noMotion(),
                       test::frame({test::scanAt(0), test::odometryAt(0, CPose2D(5, 0, 0))}),
                       test::noMotion(),
                       test::frame({test::scanAt(1), test::odometryAt(2, CPose2D(7, 0, 0))})})));
    EXPECT_TRUE(log.hasOdometry);
    EXPECT_NEAR(log.steps.at(0).odometry.x(), 5, 1e-9);
    EXPECT_NEAR(log.steps.at(1).odometry.x(), 6, 1e-6);  // the scan came a second earlier
    EXPECT_FALSE(log.steps[1].increment);
}

TEST(CLogReader, FramesWhoseStampsDoNotAdvanceGiveNoHistory) {
    const CTemporaryFolder folder;
    const auto log = readLog(folder.write(
        "log.rawlog",
        test::bytesOf({test::motion(CPose2D(1, 0, 0)), test::frame({test::scanAt(0)}),
                       test::motion(CPose2D(1, 0, 0)), test::frame({test::scanAt(0)})})));
    ASSERT_EQ(log.steps.size(), 2U);
    EXPECT_NEAR(log.steps[1].odometry.x(), 2, 1e-12);
    EXPECT_TRUE(log.odometry.empty());
    EXPECT_TRUE(log.hasOdometry);
}

TEST(CLogReader, ACompanionJoinsAnObservationLogByTime) {
    const CTemporaryFolder folder;
    const auto file = folder.write("log.rawlog", test::bytesOf({test::scanAt(0), test::scanAt(1)}));
    folder.write("log.salient.rawlog",
                 test::packed(test::bytesOf(
                     {test::recordAt(0.5), test::headAt(0.2, 0.1), test::headAt(0.4, 0.3)})));
    const auto log = readLog(file);
    EXPECT_EQ(log.companionFile, (folder / "log.salient.rawlog").string());
    EXPECT_EQ(times(log), (std::vector<double>{0, 0.5, 1}));
    EXPECT_FALSE(log.panTilt.empty());
    EXPECT_NEAR(log.panTilt.cameraPose(test::kStart + 0.3, 0)->yaw(), 0.2, 1e-6);
    observations::TLogReaderOptions alone;
    alone.mergeCompanion = false;
    EXPECT_EQ(readLog(file, alone).steps.size(), 2U);
}

TEST(CLogReader, ACompanionsRecordGoesToTheFrameOfItsPicture) {
    const CTemporaryFolder folder;
    const auto file = folder.write(
        "log.rawlog",
        test::bytesOf({test::motion(CPose2D(1, 0, 0)),
                       test::frame({test::scanAt(0), test::pictureAt(0.9, "a.jpg")}),
                       test::motion(CPose2D(1, 0, 0)),
                       test::frame({test::scanAt(1), test::pictureAt(1.9, "b.jpg")})}));
    // The scan of the second frame is nearer to the first picture than that of the first.
    folder.write("log.salient.rawlog", test::bytesOf({test::recordAt(0.9), test::recordAt(1.7)}));
    const auto log = readLog(file);
    ASSERT_EQ(log.steps.size(), 2U);
    for (const auto& step : log.steps) {
        ASSERT_EQ(step.observations.size(), 3U);
        EXPECT_TRUE(std::dynamic_pointer_cast<observations::CObservationSalientLandmarks>(
            step.observations[2]));
    }
}

TEST(CLogReader, RecordsOfEqualStampsGoToTheFramesInTurn) {
    const CTemporaryFolder folder;
    const auto file = folder.write(
        "log.rawlog",
        test::bytesOf({test::motion(CPose2D(1, 0, 0)), test::frame({test::scanAt(0)}),
                       test::motion(CPose2D(1, 0, 0)), test::frame({test::scanAt(0)})}));
    folder.write("log.salient.rawlog", test::bytesOf({test::recordAt(0), test::recordAt(0)}));
    const auto log = readLog(file);
    EXPECT_EQ(log.steps.at(0).observations.size(), 2U);
    EXPECT_EQ(log.steps.at(1).observations.size(), 2U);
}

TEST(CLogReader, ReadsTheLogsThatComeWithMrpt) {
    const std::string folder = "/usr/share/mrpt/datasets/";
    if (!std::filesystem::exists(folder + "kf-slam_demo.rawlog"))
        GTEST_SKIP() << "SKIPPED, package mrpt-common is not here: " << folder;
    const auto kalman = readLog(folder + "kf-slam_demo.rawlog");
    // The log begins with a frame before any action: 249 pairs and that one.
    EXPECT_EQ(kalman.steps.size(), 250U);
    EXPECT_FALSE(kalman.steps[0].increment);
    EXPECT_TRUE(kalman.steps[1].increment);
    EXPECT_TRUE(kalman.odometry.empty());  // three different stamps in all
    const auto spatial = readLog(folder + "kf-slam_6D_demo.rawlog");
    EXPECT_EQ(spatial.steps.size(), 600U);
    EXPECT_TRUE(spatial.steps[599].increment);
    const auto laser = readLog(folder + "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog");
    EXPECT_EQ(laser.counts.at("mrpt::obs::CObservation2DRangeScan"), laser.steps.size());
    EXPECT_FALSE(laser.odometry.empty());
    EXPECT_EQ(readLog(folder + "test_rtk_path.rawlog").counts.at("mrpt::obs::CObservationGPS"),
              691U);
}
