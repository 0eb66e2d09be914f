// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/registerClasses.h>
#include <salma/simulator/CSimulator.h>

#include <cmath>
#include <map>
#include <sstream>

#include "room.h"

namespace salma::simulator {
namespace {

namespace fs = std::filesystem;
using test::CTemporaryFolder;
using test::readFile;

/// Content of every file below `folder`, by its relative name.
std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            all[fs::relative(entry.path(), folder).string()] = readFile(entry.path());
    return all;
}

std::map<std::string, std::string> simulate(const TWorld& world,
                                            const TSimulationOptions& options) {
    const CTemporaryFolder out;
    CSimulator(world, options).run(out.path());
    return contents(out.path());
}

TEST(CSimulator, SameSeedSameBytesWhateverTheThreads) {
    const CTemporaryFolder folder;
    const TWorld world = load(folder, markerIni());
    const auto first = simulate(world, {1, 1}), second = simulate(world, {1, 2}),
               other = simulate(world, {2, 1});
    ASSERT_GE(first.size(), 6u);
    EXPECT_EQ(first, second);
    EXPECT_NE(first.at("room.rawlog"), other.at("room.rawlog"));
    EXPECT_NE(first.at("room.sightings.csv"), other.at("room.sightings.csv"));
}

TEST(CSimulator, ItsLogHoldsWhatTheTruthSays) {
    const CTemporaryFolder folder, out;
    const TWorld world = load(folder, markerIni());
    CSimulator simulator(world, {1, 1});
    const auto summary = simulator.run(out.path());
    observations::registerClasses();
    const auto log = observations::readLog((out / "room.rawlog").string());
    EXPECT_EQ(log.counts.at("mrpt::obs::CObservationImage"), summary.pictures);
    EXPECT_EQ(log.counts.at("mrpt::obs::CObservation2DRangeScan"), summary.scans);
    EXPECT_NEAR(static_cast<double>(summary.scans), summary.duration * 5, 1.01);
    std::istringstream truth(readFile(out / "room.gt.tum"));
    std::size_t rows = 0;
    for (std::string line; std::getline(truth, line);) ++rows;
    EXPECT_EQ(rows, summary.odometryRecords);
}

TEST(CSimulator, PanTiltRecordsGiveTheCameraPoseOfThePictures) {
    const CTemporaryFolder folder, out;
    CSimulator(load(folder, markerIni()), {1, 1}).run(out.path());
    observations::registerClasses();
    const auto log = observations::readLog((out / "room.rawlog").string());
    std::size_t pictures = 0;
    for (const auto& step : log.steps)
        for (const auto& observation : step.observations) {
            const auto picture =
                std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(observation);
            if (!picture) continue;
            ++pictures;
            const auto pose = log.panTilt.cameraPose(step.time, 0.2);
            ASSERT_TRUE(pose);
            EXPECT_NEAR((pose->asVectorVal() - picture->cameraPose.asVectorVal()).norm(), 0, 1e-6);
            EXPECT_TRUE(fs::exists(out / "room_Images" / picture->image.getExternalStorageFile()));
        }
    EXPECT_GE(pictures, 3u);
}

TEST(CSimulator, LatencyMovesTheStampsOfPicturesOnly) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, markerIni());
    const CSimulator prompt(world, {1, 1});
    world.camera.latency = 0.1;
    const CSimulator late(world, {1, 1});
    for (std::size_t i = 0; i < prompt.pictureCount(); ++i) {
        const auto a = prompt.sightingsInPicture(i), b = late.sightingsInPicture(i);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t k = 0; k < a.size(); ++k) {
            EXPECT_NEAR(b[k].stamp - a[k].stamp, 0.1, 1e-5);
            EXPECT_EQ(a[k].u, b[k].u);
            EXPECT_EQ(a[k].bearing, b[k].bearing);
        }
    }
}

// The marker hangs at (4, 0.3); the robot drives along the x axis, so that it is on the left.
TEST(CSimulator, BearingsAreInTheRobotFrameAndLeftIsPositive) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, markerIni() + "[head]\nmode = fixed:0\n");
    world.path.wander = 0;
    const CSimulator simulator(world, {1, 1});
    ASSERT_GT(simulator.pictureCount(), 0u);
    for (std::size_t i = 0; i < simulator.pictureCount(); ++i) {
        const auto seen = simulator.sightingsInPicture(i);
        ASSERT_EQ(seen.size(), 1u);
        const double x = std::sqrt(seen[0].range * seen[0].range - 0.09);
        EXPECT_NEAR(seen[0].bearing, std::atan2(0.3, x), 1e-9);
        EXPECT_LT(seen[0].u, 383.5);  // left of the picture's middle
        EXPECT_LT(seen[0].v, 245.5);  // the marker is higher than the camera
    }
}

TEST(CSimulator, CornersAreSeenByTheLaserFromTheFirstScanOn) {
    const CTemporaryFolder folder, out;
    CSimulator(load(folder, roomIni()), {1, 1}).run(out.path());
    std::istringstream rows(readFile(out / "room.sightings.csv"));
    std::string header, row;
    std::getline(rows, header);
    EXPECT_EQ(header, "t_s,landmark_id,u_px,v_px,range_m,bearing_deg");
    // the two corners ahead, (4, +-1.5), lie at atan(1.5 / 4) = 20.6 deg from the start
    ASSERT_TRUE(std::getline(rows, row));
    EXPECT_NE(row.find(",,,4.27"), std::string::npos) << row;
    EXPECT_NEAR(std::abs(std::stod(row.substr(row.rfind(',') + 1))), 20.556, 0.1);
}

}  // namespace
}  // namespace salma::simulator
