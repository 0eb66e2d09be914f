// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/registerClasses.h>

#include <algorithm>

#include "CProcess.h"
#include "CTemporaryFolder.h"

namespace salma {
namespace {

namespace fs = std::filesystem;
using test::CTemporaryFolder;
using test::TProcessResult;

const std::string kRoom =
    "[path]\npoints_m = 0 0 0.6 0\nclosed = false\nlaps = 1\n"
    "[wall_south]\nfrom_m = 4 -1.5\nto_m = -2 -1.5\n[wall_east]\nfrom_m = 4 1.5\nto_m = 4 -1.5\n"
    "[wall_north]\nfrom_m = -2 1.5\nto_m = 4 1.5\n[wall_west]\nfrom_m = -2 -1.5\nto_m = -2 1.5\n";

TProcessResult sim(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{test::program("salma-sim")};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return test::runProcess(command);
}

void expectOneLineError(const TProcessResult& result, const std::string& part) {
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_EQ(result.output.find("salma-sim: "), 0u) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

TEST(SalmaSim, HelpStartsWithTwoExamples) {
    const auto result = sim({"--help"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.output.find("Examples:\n  salma-sim share/worlds/hallway-loop.ini --out "), 0u)
        << result.output;
}

TEST(SalmaSim, WritesALogThatCanBeReadAndItsTruth) {
    const CTemporaryFolder folder;
    const auto out = folder / "out";
    const auto result = sim({folder.write("tiny.ini", kRoom), "--out", out.string(),
                             "--picture-size", "640x480", "--camera", "fixed:20"});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    for (const char* ending :
         {".rawlog", ".salient.rawlog", ".gt.tum", ".landmarks.csv", ".sightings.csv"})
        EXPECT_TRUE(fs::exists(out / ("tiny" + std::string(ending)))) << ending;
    observations::registerClasses();
    EXPECT_TRUE(observations::readLog((out / "tiny.rawlog").string()).hasOdometry);
    EXPECT_FALSE(fs::is_empty(out / "tiny_Images"));
}

TEST(SalmaSim, DrawsSightingsFromABankThatItBuildsOnce) {
    const CTemporaryFolder folder;
    const auto world = folder.write("tiny.ini", kRoom);
    const auto bank = (folder / "tiny.bank").string();
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{
            world, "--out", (folder / "out").string(), "--sightings", bank, "--draws", "1"};
        all.insert(all.end(), more.begin(), more.end());
        return sim(all);
    };
    const std::vector<std::string> fixed{"--camera", "fixed:20", "--picture-size", "640x480"};
    auto result = run(fixed);
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("drawn from the bank"), std::string::npos) << result.output;
    observations::registerClasses();
    const auto log = observations::readLog((folder / "out/tiny.rawlog").string());
    EXPECT_EQ(log.counts.count("salma::observations::CObservationSalientLandmarks"), 1u);
    EXPECT_EQ(log.counts.count("mrpt::obs::CObservationImage"), 0u);

    const auto built = test::readFile(bank);
    result = run({"--camera", "fixed:20", "--picture-size", "640x480", "--seed", "2"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_TRUE(test::readFile(bank) == built);
    expectOneLineError(run({"--camera", "fixed:30"}), "tiny.bank: is a bank of something else");
    expectOneLineError(run({"--camera", "attend"}), "'attend'");
    expectOneLineError(run({"--seed", "1000001"}), "is one of the bank's");
    folder.write("tiny.bank", built.substr(0, built.size() / 2));
    expectOneLineError(run(fixed), "tiny.bank: breaks off");
    EXPECT_EQ(sim({world, "--out", "x", "--draws", "2"}).exitCode, 2);
}

TEST(SalmaSim, PrintsTheEffectiveWorldWithItsFlags) {
    const CTemporaryFolder folder;
    const auto result =
        sim({folder.write("tiny.ini", kRoom), "--print-config", "--odometry-noise", "high"});
    EXPECT_EQ(result.exitCode, 0);
    const auto place = result.output.find("noise_level");
    ASSERT_NE(place, std::string::npos) << result.output;
    EXPECT_EQ(result.output.substr(place).find("= high"), result.output.substr(place).find("= "))
        << result.output;
    EXPECT_NE(result.output.find("[wall_south]"), std::string::npos);
}

TEST(SalmaSim, RefusesBadWorldsInOneLineAndLeavesNothing) {
    const CTemporaryFolder folder;
    const auto out = (folder / "out").string();
    expectOneLineError(sim({"/no/such.ini", "--out", out}), "/no/such.ini: no such file");
    const auto gone =
        folder.write("gone.ini", kRoom + "[poster_p]\nwall = east\nat_m = 1\ntexture = gone.jpg\n");
    expectOneLineError(sim({gone, "--out", out}), "gone.ini: [poster_p] texture = 'gone.jpg'");
    const auto tiny = folder.write("tiny.ini", kRoom);
    expectOneLineError(sim({tiny, "--out", out, "--camera", "fixed:999"}), "fixed:999");
    expectOneLineError(sim({tiny, "--out", out, "--laps", "2"}), "laps = 2");
    expectOneLineError(sim({tiny}), "--out is missing");
    EXPECT_FALSE(fs::exists(out));
}

TEST(SalmaSim, DoesNotReplaceAFolderThatIsNotItsOwn) {
    const CTemporaryFolder folder;
    folder.write("mine/letter.txt", "keep me");
    expectOneLineError(sim({folder.write("tiny.ini", kRoom), "--out", (folder / "mine").string()}),
                       "was not written by salma");
    EXPECT_TRUE(fs::exists(folder / "mine/letter.txt"));
}

TEST(SalmaSim, UnknownFlagsAndValuesAreMisuse) {
    const CTemporaryFolder folder;
    const auto tiny = folder.write("tiny.ini", kRoom);
    EXPECT_EQ(sim({tiny, "--colour"}).exitCode, 2);
    EXPECT_EQ(sim({tiny, "--out", "x", "--odometry-noise", "loud"}).exitCode, 2);
    EXPECT_EQ(sim({tiny, "--out", "x", "--picture-size", "1x1"}).exitCode, 2);
    EXPECT_EQ(sim({tiny, "--out", "x", "--threads", "0"}).exitCode, 2);
    EXPECT_EQ(sim({}).exitCode, 2);
}

}  // namespace
}  // namespace salma
