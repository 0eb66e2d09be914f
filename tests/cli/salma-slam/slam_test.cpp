// SPDX-License-Identifier: BSD-3-Clause
#include <CProcess.h>
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace salma {
namespace {

namespace fs = std::filesystem;
using test::CTemporaryFolder;
using test::program;
using test::readFile;
using test::runProcess;
using test::TProcessResult;

const std::string kConfig = SALMA_SOURCE_DIR "/config.ini";
const std::string kDatasets = "/usr/share/mrpt/datasets/";
const std::string kSena = kDatasets + "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";

TProcessResult slam(const std::string& config,
                    const std::string& log,
                    const fs::path& out,
                    const std::vector<std::string>& flags = {}) {
    std::vector<std::string> command{program("salma-slam"), config, log, "--out", out.string()};
    command.insert(command.end(), flags.begin(), flags.end());
    return runProcess(command);
}

void expectOneLineError(const TProcessResult& result, const std::string& part) {
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    EXPECT_EQ(result.output.find("salma-slam: "), 0u) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

/// A short simulated log, made once for all tests of this program.
std::string simulatedLog() {
    static const CTemporaryFolder folder;  // removed when the test program ends
    static const TProcessResult made =
        runProcess({program("salma-sim"), SALMA_SOURCE_DIR "/tests/data/worlds/two-posters.ini",
                    "--out", (folder / "sim").string()});
    EXPECT_EQ(made.exitCode, 0) << made.output;
    return (folder / "sim/two-posters.rawlog").string();
}

TEST(SalmaSlam, ShippedConfigHoldsEveryKeyWithItsDefault) {
    const std::string shipped = readFile(kConfig);
    const auto printed = runProcess({program("salma-slam"), "--print-config"});
    EXPECT_EQ(printed.exitCode, 0);
    const auto firstSection = shipped.find("\n[");
    ASSERT_NE(firstSection, std::string::npos);
    EXPECT_EQ(shipped.substr(firstSection + 1), printed.output);
    const auto read = runProcess({program("salma-slam"), kConfig, "--print-config"});
    EXPECT_EQ(read.output, printed.output);
}

TEST(SalmaSlam, TellsMisuseFromFailureByItsExitCode) {
    EXPECT_EQ(runProcess({program("salma-slam"), "--no-such-flag"}).exitCode, 2);
    EXPECT_EQ(runProcess({program("salma-slam")}).exitCode, 2);
    EXPECT_EQ(runProcess({program("salma-slam"), kConfig, kSena, "--association", "jcbb"}).exitCode,
              2);
    EXPECT_EQ(runProcess({program("salma-slam"), "--version"}).exitCode, 0);
    const auto help = runProcess({program("salma-slam"), "--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.output.find("Examples:\n  salma-slam config.ini"), 0u) << help.output;
}

TEST(SalmaSlam, RefusesAConfigurationWithAMistakeAndNamesIt) {
    const CTemporaryFolder folder;
    const auto with = [&](const std::string& ini) {
        return slam(folder.write("my.ini", ini), kSena, folder / "out");
    };
    expectOneLineError(with("[lines]\ninlier = 0.1\n"), "[lines] has unknown keys: inlier");
    expectOneLineError(with("[line]\ninlier_m = 0.1\n"), "unknown sections: [line]");
    expectOneLineError(with("[lines]\ninlier_m = -1\n"), "[lines] inlier_m = '-1' is outside");
    expectOneLineError(with("[lines]\ninlier_m = 1O\n"), "is not a number");
    expectOneLineError(with("[lines]\ninlier_m\n"), "my.ini:2");
    expectOneLineError(slam((folder / "no.ini").string(), kSena, folder / "out"), "no.ini");
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(SalmaSlam, RefusesRawlogsThatAreNone) {
    const CTemporaryFolder folder;
    expectOneLineError(slam(kConfig, (folder / "no.rawlog").string(), folder / "out"), "no.rawlog");
    expectOneLineError(slam(kConfig, folder.write("empty.rawlog", ""), folder / "out"),
                       "empty.rawlog");
    expectOneLineError(slam(kConfig, folder.write("text.rawlog", "hello, robot\n"), folder / "out"),
                       "text.rawlog");
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(SalmaSlam, RefusesATruncatedRawlogUnlessToldOtherwise) {
    if (!fs::exists(kSena)) GTEST_SKIP() << "SKIPPED, not here: " << kSena;
    const CTemporaryFolder folder;
    const std::string whole = readFile(kSena);
    const auto cut = folder.write("cut.rawlog", whole.substr(0, whole.size() * 2 / 3));
    expectOneLineError(slam(kConfig, cut, folder / "out"), "cut.rawlog");
    EXPECT_FALSE(fs::exists(folder / "out"));
    const auto accepted = slam(kConfig, cut, folder / "out", {"--accept-truncated"});
    EXPECT_EQ(accepted.exitCode, 0) << accepted.output;
    EXPECT_NE(accepted.output.find("notice: the log breaks off"), std::string::npos);
}

TEST(SalmaSlam, RefusesAnOutputFolderThatItCannotOrMayNotWrite) {
    const CTemporaryFolder folder;
    expectOneLineError(slam(kConfig, kSena, "/proc/no-such/out"), "/proc/no-such/out");
    folder.write("mine/precious.txt", "keep me");
    expectOneLineError(slam(kConfig, kSena, folder / "mine"), "was not written by salma");
    EXPECT_EQ(readFile(folder / "mine/precious.txt"), "keep me");
}

TEST(SalmaSlam, RunsOnARealLaserLogWithCornersAlone) {
    if (!fs::exists(kSena)) GTEST_SKIP() << "SKIPPED, not here: " << kSena;
    const CTemporaryFolder folder;
    const auto result = slam(kConfig, kSena, folder / "out");
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("notice: no pictures in the log"), std::string::npos);
    for (const std::string file :
         {"trajectory.tum", "landmarks.csv", "associations.csv", "candidates.csv",
          "innovations.csv", "relocations.csv", "summary.json", "landmarks.db", "map.png",
          "innovations.png", "scene.3Dscene", "report.html"})
        EXPECT_TRUE(fs::file_size(folder / ("out/" + file)) > 0) << file;
    const auto summary = nlohmann::json::parse(readFile(folder / "out/summary.json"));
    EXPECT_EQ(summary.at("steps"), 225);
    EXPECT_GT(summary.at("landmarks"), 10);
    EXPECT_EQ(summary.at("pictures"), 0);
    expectOneLineError(slam(kConfig, kSena, folder / "none", {"--require", "pictures"}),
                       "holds no pictures");
    // a second run replaces the first
    EXPECT_EQ(slam(kConfig, kSena, folder / "out").exitCode, 0);
}

TEST(SalmaSlam, FailsWhenNoLandmarkSourceIsLeft) {
    if (!fs::exists(kSena)) GTEST_SKIP() << "SKIPPED, not here: " << kSena;
    const CTemporaryFolder folder;
    const auto ini = folder.write("my.ini", "[run]\ncorners = false\n");
    const auto result = slam(ini, kSena, folder / "out");
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.output.find("no landmark source"), std::string::npos) << result.output;
}

TEST(SalmaSlam, RunsOnARangeBearingLogWithoutLaser) {
    const std::string log = kDatasets + "kf-slam_demo.rawlog";
    if (!fs::exists(log)) GTEST_SKIP() << "SKIPPED, not here: " << log;
    const CTemporaryFolder folder;
    const auto result = slam(kConfig, log, folder / "out");
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto summary = nlohmann::json::parse(readFile(folder / "out/summary.json"));
    EXPECT_EQ(summary.at("steps"), 250);
    EXPECT_EQ(summary.at("landmarks"), 70) << "known identities";
}

TEST(SalmaSlam, RunsOnARangeBearingLogInSpace) {
    const std::string log = kDatasets + "kf-slam_6D_demo_DA.rawlog";
    if (!fs::exists(log)) GTEST_SKIP() << "SKIPPED, not here: " << log;
    const CTemporaryFolder folder;
    const auto planar = slam(kConfig, log, folder / "planar");
    EXPECT_EQ(planar.exitCode, 1);
    EXPECT_NE(planar.output.find("state = 6d"), std::string::npos) << planar.output;
    const auto result = slam(SALMA_SOURCE_DIR "/share/range-bearing/space.ini", log, folder / "out",
                             {"--ignore-ids"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    const std::string map = readFile(folder / "out/landmarks3d.csv");
    EXPECT_EQ(map.rfind("id,x_m,y_m,z_m,sigma_x_m,sigma_y_m,sigma_z_m,sightings\n", 0), 0u) << map;
    EXPECT_EQ(std::count(map.begin(), map.end(), '\n'), 1 + 20);
    EXPECT_NE(readFile(folder / "out/innovations.csv").find("pitch_deg"), std::string::npos);
}

TEST(SalmaSlam, SeesPostersInASimulatedObservationOnlyLogAndReplaysItsRecords) {
    const std::string log = simulatedLog();
    const CTemporaryFolder folder;
    const auto seen = slam(kConfig, log, folder / "seen", {"--save-rawlog", "--embed"});
    ASSERT_EQ(seen.exitCode, 0) << seen.output;
    const auto summary = nlohmann::json::parse(readFile(folder / "seen/summary.json"));
    EXPECT_GT(summary.at("pictures"), 5);
    EXPECT_NE(readFile(folder / "seen/landmarks.csv").find("salient"), std::string::npos);
    // the same landmarks without looking at a picture again
    const auto replayed =
        slam(kConfig, (folder / "seen/two-posters.rawlog").string(), folder / "replayed");
    ASSERT_EQ(replayed.exitCode, 0) << replayed.output;
    EXPECT_EQ(readFile(folder / "seen/landmarks.csv"), readFile(folder / "replayed/landmarks.csv"));
    EXPECT_EQ(readFile(folder / "seen/trajectory.tum"),
              readFile(folder / "replayed/trajectory.tum"));
}

TEST(SalmaSlam, MapsWithParticles) {
    const CTemporaryFolder folder;
    const auto ini = folder.write("p.ini", "[run]\nbackend = rbpf\n[rbpf]\nparticles = 15\n");
    const auto first = slam(ini, simulatedLog(), folder / "a");
    ASSERT_EQ(first.exitCode, 0) << first.output;
    EXPECT_NE(readFile(folder / "a/landmarks.csv").find("salient"), std::string::npos);
    ASSERT_EQ(slam(kConfig, simulatedLog(), folder / "b", {"--backend", "ekf"}).exitCode, 0);
    EXPECT_NE(readFile(folder / "a/trajectory.tum"), readFile(folder / "b/trajectory.tum"));
    // the seed decides, and nothing else
    ASSERT_EQ(slam(ini, simulatedLog(), folder / "c", {"--seed", "1"}).exitCode, 0);
    EXPECT_EQ(readFile(folder / "a/trajectory.tum"), readFile(folder / "c/trajectory.tum"));
    ASSERT_EQ(slam(ini, simulatedLog(), folder / "d", {"--seed", "2"}).exitCode, 0);
    EXPECT_NE(readFile(folder / "a/trajectory.tum"), readFile(folder / "d/trajectory.tum"));
}

TEST(SalmaSlam, GivesTheSameResultForAnyNumberOfThreads) {
    const CTemporaryFolder folder;
    for (const std::string threads : {"1", "3"}) {
        const auto ini = folder.write("t.ini", "[run]\nthreads = " + threads + "\n");
        ASSERT_EQ(slam(ini, simulatedLog(), folder / threads).exitCode, 0);
    }
    for (const std::string file : {"trajectory.tum", "landmarks.csv", "associations.csv"})
        EXPECT_EQ(readFile(folder / ("1/" + file)), readFile(folder / ("3/" + file))) << file;
}

TEST(SalmaSlam, TakesMissingPictureFilesForANotice) {
    const CTemporaryFolder folder;
    fs::copy(simulatedLog(), folder / "bare.rawlog");
    fs::copy(fs::path(simulatedLog()).replace_extension(".salient.rawlog"),
             folder / "bare.salient.rawlog");
    const auto result = slam(kConfig, (folder / "bare.rawlog").string(), folder / "out");
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("pictures are missing"), std::string::npos) << result.output;
    const auto required =
        slam(kConfig, (folder / "bare.rawlog").string(), folder / "no", {"--require", "pictures"});
    EXPECT_EQ(required.exitCode, 1);
    EXPECT_FALSE(fs::exists(folder / "no"));
}

TEST(SalmaSlam, TakesTheRegionsOfAnotherProgramAndSurvivesItsFaults) {
    const CTemporaryFolder folder;
    const auto with = [&](const std::string& command, const std::string& more = "") {
        const auto ini = folder.write(
            "my.ini",
            "[selection]\ndetector = external\n[external]\ncommand = " + command + "\n" + more);
        return slam(ini, simulatedLog(), folder / "out");
    };
    const auto regions =
        folder.write("regions", "1.0\n2\n320 200 0.01 0 0.01\n330 210 0.01 0 0.01\n");
    EXPECT_EQ(with("sh -c \"cp " + regions + " {regions}; test -s {image}\"").exitCode, 0);
    fs::remove_all(folder / "out");
    const auto fails = [&](const TProcessResult& result, const std::string& part) {
        EXPECT_EQ(result.exitCode, 1) << result.output;
        EXPECT_NE(result.output.find("salma-slam: external detector '"), std::string::npos)
            << result.output;
        EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
        EXPECT_FALSE(fs::exists(folder / "out"));
    };
    fails(with("sh -c \"kill -SEGV $$\" {image} {regions}"), "Segmentation fault");
    fails(with("sh -c \"sleep 100\" {image} {regions}", "time_limit_s = 0.1\n"),
          "did not end within");
    fails(with("cp {image} {regions}"), "wrote no good region file, line:1");
    EXPECT_EQ(with("").exitCode, 1);
}

TEST(SalmaSlam, LeavesNoFolderWhenItIsKilled) {
    const CTemporaryFolder folder;
    const auto killed = runProcess({"timeout", "-s", "KILL", "0.5", program("salma-slam"), kConfig,
                                    simulatedLog(), "--out", (folder / "out").string()});
    EXPECT_NE(killed.exitCode, 0);
    EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace salma
