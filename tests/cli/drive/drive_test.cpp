// SPDX-License-Identifier: BSD-3-Clause
// One emulated drive from cables to a map: laser, head and base on pseudo-terminals, pictures in a
// folder, recorded by a grabber in a process of its own from the shipped ini file, mapped by
// salma-slam. Compared with the map from the simulator's own log of the same drive.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "CEmulatedDrive.h"
#include "CProcess.h"
#include "CRunningProcess.h"
#include "CTemporaryFolder.h"

namespace fs = std::filesystem;
using namespace salma;

namespace {

const char* const kWorld = SALMA_SOURCE_DIR "/tests/emulators/robot/short-corridor.ini";

/// What salma-slam said of a run.
struct TMap {
    int salient{-1}, corners{-1};
    double error{-1};  //!< ATE [m].
    std::string output;
};

class Drive : public testing::Test {
 protected:
    static TMap mapOf(const fs::path& log, const fs::path& out) {
        TMap map;
        map.output = test::runProcess({test::program("salma-slam"), SALMA_SOURCE_DIR "/config.ini",
                                       log.string(), "--out", out.string()})
                         .output;
        std::smatch found;
        const std::regex counts("(\\d+) salient landmarks, (\\d+) corners");
        if (std::regex_search(map.output, found, counts)) {
            map.salient = std::stoi(found[1]);
            map.corners = std::stoi(found[2]);
        }
        const std::regex error("ATE ([0-9.]+) m");
        if (std::regex_search(map.output, found, error)) map.error = std::stod(found[1]);
        return map;
    }

    TMap simulated() const {
        const fs::path folder = m_folder / "simulated";
        const auto run = test::runProcess(
            {test::program("salma-sim"), kWorld, "--out", folder.string(), "--seed", "1"});
        EXPECT_EQ(run.exitCode, 0) << run.output;
        return mapOf(folder / "short-corridor.rawlog", m_folder / "simulated-map");
    }

    /// Until the robot has arrived, and four seconds more; false if the grabber ends before.
    static bool waitForArrival(const test::CEmulatedDrive& robot, test::CRunningProcess& grabber) {
        const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(200);
        while (!robot.arrived()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            if (!grabber.running() || std::chrono::steady_clock::now() > limit) return false;
        }
        std::this_thread::sleep_for(std::chrono::seconds(4));
        return grabber.running();
    }

    /// The camera's intrinsics into the log, as after salma-calib; the truth beside it.
    void complete(const fs::path& log, test::CEmulatedDrive& robot) const {
        const fs::path edited = m_folder / "edited.rawlog";
        const auto run = test::runProcess({"rawlog-edit", "-p", SALMA_PLUGIN, "-i", log.string(),
                                           "-o", edited.string(), "--camera-params",
                                           "CAMERA," + (m_folder / "camera.ini").string()});
        ASSERT_EQ(run.exitCode, 0) << run.output;
        fs::rename(edited, log);
        robot.writeTruth(fs::path(log).replace_extension(".gt.tum"));
    }

    /// A map as good as that from the simulator's own log.
    void expectAsGood(const fs::path& log) const {
        const TMap map = mapOf(log, m_folder / "map"), own = simulated();
        std::cout << "from " << log << "\n"
                  << map.output << "from the simulator's own log\n"
                  << own.output;
        ASSERT_GE(own.salient, 4);
        ASSERT_GT(own.error, 0);
        ASSERT_GT(map.error, 0);
        EXPECT_GE(map.salient, own.salient - 1);
        EXPECT_LE(map.salient, own.salient + 1);
        EXPECT_NEAR(map.corners, own.corners, 6);
        EXPECT_LE(map.error, own.error + 0.03);
    }

    /// Each salient landmark of the map is a poster; the map begins at the robot's start.
    void expectPostersInTheirPlaces(const test::CEmulatedDrive& robot) const {
        std::istringstream table(test::readFile(m_folder / "map" / "landmarks.csv"));
        std::set<int> found;
        for (std::string line; std::getline(table, line);) {
            const std::regex row("\\d+,salient,([-0-9.e]+),([-0-9.e]+),.*");
            std::smatch fields;
            if (!std::regex_match(line, fields, row)) continue;
            const auto place =
                robot.start().composePoint({std::stod(fields[1]), std::stod(fields[2])});
            double nearest = 1e9;
            int poster = 0;
            for (const auto& landmark : robot.simulator().world().landmarks()) {
                const double distance =
                    std::hypot(landmark.centre.x() - place.x, landmark.centre.y() - place.y);
                if (landmark.kind != simulator::ETruthKind::salient || distance > nearest) continue;
                nearest = distance;
                poster = landmark.id;
            }
            EXPECT_LT(nearest, 0.15) << line;
            EXPECT_TRUE(found.insert(poster).second) << "twice in the map: " << poster;
        }
        EXPECT_GE(found.size(), 4U);
    }

    test::CTemporaryFolder m_folder;
};

}  // namespace

TEST_F(Drive, SalmaGrabRecordsAMapAsGoodAsTheSimulatorsOwn) {
    test::CEmulatedDrive robot(simulator::loadWorld(kWorld), 1, m_folder.path(), 7);
    const fs::path log = m_folder / "drive.rawlog";
    test::CRunningProcess grabber(
        {test::program("salma-grab"), (m_folder / "robot.ini").string(), "--out", log.string()});
    const bool arrived = waitForArrival(robot, grabber);
    grabber.signal(SIGINT);
    const auto result = grabber.wait();
    ASSERT_TRUE(arrived) << result.output;
    EXPECT_EQ(result.exitCode, 0) << result.output;
    complete(log, robot);
    expectAsGood(log);
    expectPostersInTheirPlaces(robot);
}

TEST_F(Drive, StockRawlogGrabberRecordsAMapAsGoodAsTheSimulatorsOwn) {
    if (std::system("command -v rawlog-grabber >/dev/null") != 0)
        GTEST_SKIP() << "SKIPPED, rawlog-grabber of package mrpt-apps is not here";
    test::CEmulatedDrive robot(simulator::loadWorld(kWorld), 1, m_folder.path(), 7);
    const std::string keyboard = m_folder / "keys";
    ASSERT_EQ(mkfifo(keyboard.c_str(), 0600), 0);
    // Open for reading as well: the grabber never sees an end of file, which it takes for a key.
    const int keys = open(keyboard.c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_GE(keys, 0);
    test::CRunningProcess grabber({"sh", "-c",
                                   "exec rawlog-grabber -p " SALMA_PLUGIN " " +
                                       (m_folder / "robot.ini").string() + " < " + keyboard});
    const bool arrived = waitForArrival(robot, grabber);
    EXPECT_EQ(write(keys, "q\n", 2), 2);
    const auto result = grabber.wait();
    close(keys);
    ASSERT_TRUE(arrived) << result.output;
    fs::path log;
    for (const auto& entry : fs::directory_iterator(m_folder.path()))
        if (entry.path().extension() == ".rawlog") log = entry.path();
    ASSERT_FALSE(log.empty()) << result.output;
    complete(log, robot);
    expectAsGood(log);
    expectPostersInTheirPlaces(robot);
}
