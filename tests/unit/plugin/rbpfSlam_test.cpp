// SPDX-License-Identifier: BSD-3-Clause
// The stock program rbpf-slam of MRPT with this project's metric map, which the plug-in registers.
#include <gtest/gtest.h>
#include <salma/observations/CObservationSalientLandmarks.h>

#include <cstdlib>
#include <filesystem>
#include <random>
#include <sstream>

#include "CProcess.h"
#include "CTemporaryFolder.h"
#include "examples.h"
#include "logs.h"

#ifndef SALMA_PRELOAD
#define SALMA_PRELOAD ""
#endif

namespace salma {
namespace {

namespace fs = std::filesystem;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

const std::string kIni = SALMA_SOURCE_DIR "/share/rbpf-slam/landmark-map.ini";
const std::string kDemo = "/usr/share/mrpt/datasets/kf-slam_demo.rawlog";

/// The shipped ini file with ten particles, for a folder of results.
std::string smallIni(const test::CTemporaryFolder& folder, const std::string& more = "") {
    std::string text = test::readFile(kIni);
    const auto set = [&](const std::string& from, const std::string& to) {
        const auto at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
    };
    set("sampleSize = 60", "sampleSize = 10");
    set("ignore_identities = true", "ignore_identities = false");
    set("logOutput_dir = LOG_LANDMARKS", "logOutput_dir = " + (folder / "log").string());
    return folder.write("rbpf.ini", text + more);
}

test::TProcessResult rbpfSlam(const std::string& ini, const std::string& log) {
    const std::string before = *SALMA_PRELOAD == '\0' ? "" : SALMA_PRELOAD ":";
    return test::runProcess({"env", "LD_PRELOAD=" + before + SALMA_PLUGIN,
                             "ASAN_OPTIONS=detect_leaks=0", "rbpf-slam", ini, log});
}

/// The lines of the landmark file that the program leaves.
std::vector<std::string> landmarks(const test::CTemporaryFolder& folder) {
    std::vector<std::string> lines;
    for (const auto& entry : fs::directory_iterator(folder / "log")) {
        const std::string name = entry.path().filename().string();
        if (name.find("_landmarks.csv") == std::string::npos) continue;
        std::istringstream text(test::readFile(entry.path()));
        for (std::string line; std::getline(text, line);) lines.push_back(line);
    }
    return lines;
}

class RbpfSlam : public testing::Test {
 protected:
    void SetUp() override {
        if (std::system("command -v rbpf-slam >/dev/null") != 0)
            GTEST_SKIP() << "SKIPPED, rbpf-slam of package mrpt-apps is not here";
    }
};

TEST_F(RbpfSlam, MapsARangeBearingLog) {
    if (!fs::exists(kDemo)) GTEST_SKIP() << "SKIPPED, not here: " << kDemo;
    const test::CTemporaryFolder folder;
    const auto result = rbpfSlam(smallIni(folder), kDemo);
    EXPECT_EQ(result.exitCode, 0) << result.output;
    const auto lines = landmarks(folder);
    ASSERT_EQ(lines.size(), 71u) << result.output;
    EXPECT_EQ(lines[0], "id,kind,x_m,y_m,sigma_x_m,sigma_y_m,sightings");
}

TEST_F(RbpfSlam, MapsSalientLandmarksOfAnEmbeddedLog) {
    std::vector<mrpt::serialization::CSerializable::Ptr> entries;
    for (int k = 0; k < 12; ++k) {
        const auto record = test::recordAt(k);
        ASSERT_FALSE(record->landmarks.empty());
        // the robot drives 0.1 m a step towards what it saw first 5 m ahead
        for (auto& patch : record->landmarks) {
            patch.pose.mean = CPose3D(5 - 0.1 * k, 1, 1, -M_PI_2, 0, M_PI_2);
            patch.pose.cov.setDiagonal(4e-4);
        }
        entries.push_back(test::motion(CPose2D(k == 0 ? 0 : 0.1, 0, 0)));
        entries.push_back(test::frame({record}));
    }
    const test::CTemporaryFolder folder;
    const auto log = folder.write("sf.rawlog", test::packed(test::bytesOf(entries)));
    const auto result = rbpfSlam(smallIni(folder), log);
    EXPECT_EQ(result.exitCode, 0) << result.output;
    const auto lines = landmarks(folder);
    ASSERT_GE(lines.size(), 2u) << result.output;
    EXPECT_NE(lines[1].find(",salient,"), std::string::npos) << lines[1];
}

TEST_F(RbpfSlam, RefusesAMisspeltKey) {
    const test::CTemporaryFolder folder;
    const auto ini =
        smallIni(folder, "[MappingApplication_salientLandmarkMap_00_matcherOpts]\nratios = 0.8\n");
    const auto result = rbpfSlam(ini, kDemo);
    EXPECT_NE(result.exitCode, 0);
    EXPECT_NE(result.output.find("unknown keys: ratios"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace salma
