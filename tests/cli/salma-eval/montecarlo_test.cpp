// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "CProcess.h"
#include "CTemporaryFolder.h"

extern char** environ;

namespace salma::test {
namespace {

using nlohmann::json;

const std::string kConfig = SALMA_SOURCE_DIR "/config.ini";

/// two-posters.ini, driven half as far and with the camera held still: quick to simulate.
std::string worldText() {
    std::string text = readFile(SALMA_SOURCE_DIR "/tests/data/worlds/two-posters.ini");
    const auto replace = [&](const std::string& from, const std::string& to) {
        for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + 1))
            text.replace(at, from.size(), to);
    };
    replace("points_m = 0 0  5 0", "points_m = 0 0  2.5 0");
    replace("mode = attend", "mode = fixed:35");
    replace("../../../share", SALMA_SOURCE_DIR "/share");
    return text;
}

/// The same file in all tests, as long as this program runs.
const std::string& worldFile() {
    static const CTemporaryFolder folder;
    static const std::string file = folder.write("short.ini", worldText());
    return file;
}

std::vector<std::string> command(const std::string& out,
                                 const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{
        program("salma-eval"), "montecarlo",  kConfig,   "--worlds", worldFile(), "--noise", "high",
        "--methods",           "nn,saliency", "--seeds", "2",        "--out",     out};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TProcessResult study(const CTemporaryFolder& folder, const std::vector<std::string>& more = {}) {
    return runProcess(command((folder / "out").string(), more));
}

/// All that must be the same each time.
std::string tablesOf(const CTemporaryFolder& folder) {
    std::string all;
    for (const char* name : {"table.csv", "table.md", "table.json", "runs.csv"})
        all += readFile(folder / "out" / name);
    return all;
}

/// The study that the others are held against, made once for all tests.
const std::string& referenceTables() {
    static const std::string tables = [] {
        const CTemporaryFolder folder;
        const auto result = study(folder, {"--jobs", "1"});
        EXPECT_EQ(result.exitCode, 0) << result.output;
        return tablesOf(folder);
    }();
    return tables;
}

std::size_t linesIn(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::size_t lines = 0;
    for (std::string line; std::getline(in, line);) ++lines;
    return lines;
}

/// The message of a study that must fail with one line.
std::string failure(const TProcessResult& result) {
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    return result.output;
}

TEST(MonteCarlo, ScoresARunAsTheProgramsForASingleRunDo) {
    const CTemporaryFolder folder;
    const auto sim = (folder / "sim").string(), run = (folder / "run").string();
    ASSERT_EQ(runProcess({program("salma-sim"), worldFile(), "--seed", "2", "--odometry-noise",
                          "low", "--out", sim})
                  .exitCode,
              0);
    ASSERT_EQ(runProcess({program("salma-slam"), kConfig, sim + "/short.rawlog", "--association",
                          "scnn", "--seed", "2", "--out", run})
                  .exitCode,
              0);
    const auto trajectory =
        json::parse(runProcess({program("salma-eval"), "trajectory", sim + "/short.gt.tum",
                                run + "/trajectory.tum", "--json"})
                        .output);
    const auto pairs =
        json::parse(runProcess({program("salma-eval"), "associations", sim, run, "--json"}).output);

    const auto result = runProcess({program("salma-eval"), "montecarlo", kConfig, "--worlds",
                                    worldFile(), "--noise", "low", "--methods", "scnn", "--seeds",
                                    "1", "--first-seed", "2", "--out", (folder / "out").string()});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto row = json::parse(readFile(folder / "out/table.json"))["rows"][0];
    EXPECT_EQ(row["runs"], 1);
    EXPECT_EQ(row["method"], "scnn");
    EXPECT_NEAR(row["ate_m"]["mean"].get<double>(),
                trajectory["ate_aligned"]["rmse_m"].get<double>(), 1e-6);
    EXPECT_NEAR(row["ate_last_lap_m"]["mean"].get<double>(), row["ate_m"]["mean"].get<double>(),
                1e-9)
        << "it drives one lap";
    EXPECT_NEAR(row["rpe_1m_m"]["mean"].get<double>(),
                trajectory["rpe_distance"]["translation"]["rmse_m"].get<double>(), 1e-6);
    for (const auto& [ours, theirs] : std::vector<std::pair<std::string, std::string>>{
             {"precision_salient", "salient"}, {"precision_corner", "corners"}}) {
        EXPECT_EQ(row[ours]["count"], pairs[theirs]["precision"]["count"]) << ours;
        EXPECT_EQ(row[ours]["total"], pairs[theirs]["precision"]["total"]) << ours;
    }
    EXPECT_EQ(row["recall_corner"]["count"], pairs["corners"]["recall"]["count"]);
    EXPECT_EQ(row["recall_salient"]["total"], pairs["salient"]["recall"]["total"]);
    EXPECT_GT(row["recall_corner"]["total"], 20);
    EXPECT_EQ(row["corners_made"]["mean"], pairs["corners"]["landmarks_made"]);
}

TEST(MonteCarlo, WritesTablesAndPicturesAndKeepsNoLogs) {
    const CTemporaryFolder folder;
    const auto result = study(folder, {"--jobs", "4"});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("4 runs made, 0 were there"), std::string::npos) << result.output;
    EXPECT_EQ(tablesOf(folder), referenceTables()) << "any number of processes, same tables";
    for (const char* name : {"success.png", "errors.png", "consistency.png", "times.csv"})
        EXPECT_GT(std::filesystem::file_size(folder / "out" / name), 100u) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "out/logs"));
    EXPECT_EQ(linesIn(folder / "out/runs.csv"), 5u);
    EXPECT_EQ(linesIn(folder / "out/table.csv"), 3u);
}

TEST(MonteCarlo, GoesOnAfterItWasKilled) {
    const std::string& whole = referenceTables();
    std::mt19937 random(5);
    const CTemporaryFolder folder;
    const auto words = command((folder / "out").string());
    std::vector<char*> arguments;
    for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    for (int i = 0; i < 3; ++i) {
        pid_t child = 0;
        ASSERT_EQ(posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ),
                  0);
        usleep(static_cast<useconds_t>(random() % 1500000));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
    }
    const auto result = study(folder);
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(tablesOf(folder), whole);
}

TEST(MonteCarlo, MakesOnlyWhatIsMissing) {
    const CTemporaryFolder folder;
    ASSERT_EQ(study(folder).exitCode, 0);
    const std::string tables = tablesOf(folder), lines = readFile(folder / "out/results.jsonl");
    EXPECT_NE(study(folder).output.find("0 runs made, 4 were there"), std::string::npos);
    EXPECT_EQ(tablesOf(folder), tables);

    // half a line at the end is what a killed program left
    const std::string half = lines.substr(0, lines.size() - 200);
    folder.write("out/results.jsonl", half);
    EXPECT_NE(study(folder).output.find("1 runs made, 3 were there"), std::string::npos);
    EXPECT_EQ(tablesOf(folder), tables);
    EXPECT_EQ(linesIn(folder / "out/results.jsonl"), 4u);

    // another option is another study
    const auto config = folder.write("other.ini", "[ekf]\nprovisional_radius_m = 0.2\n");
    auto words = command((folder / "out").string());
    words[2] = config;
    const auto other = runProcess(words);
    EXPECT_NE(other.output.find("4 results there are of another configuration or world"),
              std::string::npos)
        << other.output;
    EXPECT_NE(other.output.find("4 runs made, 0 were there"), std::string::npos);
    EXPECT_NE(study(folder).output.find("0 runs made, 4 were there"), std::string::npos)
        << "the old results are kept";
}

TEST(MonteCarlo, CountsRunsThatFail) {
    const CTemporaryFolder folder;
    const auto limited = study(folder, {"--limit-s", "0.005"});
    ASSERT_EQ(limited.exitCode, 0) << limited.output;
    EXPECT_NE(limited.output.find("notice: 4 of 4 runs failed: its log could not be made: more "
                                  "than 0.005 s of processor time"),
              std::string::npos)
        << limited.output;
    const auto row = json::parse(readFile(folder / "out/table.json"))["rows"][0];
    EXPECT_EQ(row["failed"], 2);
    EXPECT_EQ(row["success"]["count"], 0);
    EXPECT_EQ(row["success"]["total"], 2) << "a failed run is no success";
    EXPECT_NE(study(folder).output.find("0 runs made, 4 were there"), std::string::npos);
    const auto again = study(folder, {"--retry-failed"});
    EXPECT_NE(again.output.find("4 runs made, 0 were there"), std::string::npos) << again.output;
    EXPECT_EQ(tablesOf(folder), referenceTables());
}

TEST(MonteCarlo, ARunThatThrowsIsCountedWithItsMessage) {
    // Without posters, with scans 100 m apart and pictures from before the drive, one pose of a run
    // has a reference: too few to be scored.
    const CTemporaryFolder folder;
    const auto config = folder.write(
        "lazy.ini", "[run]\nscan_distance_m = 100\n[front_end]\nlatency_camera_s = 10\n");
    std::string world = worldText();
    world = world.substr(0, world.find("[poster_"));
    const auto result =
        runProcess({program("salma-eval"), "montecarlo", config, "--worlds",
                    folder.write("bare.ini", world), "--noise", "low", "--methods", "nn",
                    "--backends", "ekf,rbpf", "--seeds", "1", "--out", (folder / "out").string()});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("notice: 2 of 2 runs failed: 1 of "), std::string::npos)
        << result.output;
    EXPECT_NE(readFile(folder / "out/runs.csv").find("at least 2 are needed"), std::string::npos);
}

TEST(MonteCarlo, TakesSightingsFromABank) {
    const CTemporaryFolder folder;
    const std::string banks = (folder / "banks").string();
    const auto first = study(folder, {"--banks", banks, "--draws", "2"});
    ASSERT_EQ(first.exitCode, 0) << first.output;
    const std::string bank = readFile(folder / "banks/short.bank"), tables = tablesOf(folder);
    const auto rows = json::parse(readFile(folder / "out/table.json"))["rows"];
    EXPECT_EQ(rows[0]["failed"], 0);
    EXPECT_GT(rows[0]["salient_made"]["mean"], 0);

    EXPECT_NE(study(folder, {"--banks", banks, "--draws", "2"}).output.find("0 runs made"),
              std::string::npos);
    EXPECT_EQ(readFile(folder / "banks/short.bank"), bank) << "it is not made again";
    EXPECT_EQ(tablesOf(folder), tables);
    EXPECT_NE(study(folder).output.find("4 results there are of another"), std::string::npos)
        << "rendered drives are others";

    EXPECT_NE(failure(study(folder, {"--banks", banks})).find("draws = 4"), std::string::npos);
    folder.write("banks/short.bank", bank.substr(0, bank.size() / 2));
    EXPECT_NE(failure(study(folder, {"--banks", banks, "--draws", "2"})).find("short.bank"),
              std::string::npos);
}

TEST(MonteCarlo, RefusesChangedResultsOrDropsAHalfLine) {
    const CTemporaryFolder folder;
    ASSERT_EQ(study(folder, {"--limit-s", "0.005"}).exitCode, 0);  // quickly made lines
    const std::string lines = readFile(folder / "out/results.jsonl");
    std::mt19937 random(7);
    for (int i = 0; i < 30; ++i) {
        std::string text = lines;
        const std::size_t at = random() % (text.size() - 1);  // not the last line break
        char other = static_cast<char>(random() % 256);
        if (other == text[at]) other = '!';
        text[at] = other;
        folder.write("out/results.jsonl", text);
        const std::string message = failure(study(folder));
        EXPECT_NE(message.find("results.jsonl:"), std::string::npos) << message;
    }
    folder.write("out/results.jsonl", "{}\n");
    EXPECT_NE(failure(study(folder)).find("results.jsonl:1: is no result"), std::string::npos);
}

TEST(MonteCarlo, RefusesBadInputBeforeAnyWork) {
    const CTemporaryFolder folder;
    const std::string out = (folder / "out").string();
    const auto run = [&](const std::string& config, const std::string& worlds) {
        return runProcess({program("salma-eval"), "montecarlo", config, "--worlds", worlds,
                           "--seeds", "1", "--out", out});
    };
    EXPECT_NE(failure(run("/no/such.ini", worldFile())).find("/no/such.ini"), std::string::npos);
    EXPECT_NE(failure(run(kConfig, "/no/world.ini")).find("/no/world.ini"), std::string::npos);
    EXPECT_NE(failure(run(kConfig, worldFile() + "," + worldFile())).find("results of both"),
              std::string::npos);
    const auto bad = folder.write("bad.ini", "[ekf]\nmax_range_m = far\n");
    EXPECT_NE(failure(run(bad, worldFile())).find("max_range_m = 'far'"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(out));
    folder.write("out/letter.txt", "mine");
    EXPECT_NE(failure(run(kConfig, worldFile())).find("was not written by salma"),
              std::string::npos);
}

TEST(MonteCarlo, UnknownFlagsAndValuesAreMisuse) {
    const CTemporaryFolder folder;
    for (const auto& more : std::vector<std::vector<std::string>>{{"--colour"},
                                                                  {"--methods", "best"},
                                                                  {"--noise", "loud"},
                                                                  {"--backends", "posegraph"},
                                                                  {"--seeds", "0"},
                                                                  {"--jobs", "0"},
                                                                  {"--draws", "3"},
                                                                  {"--limit-s", "-1"},
                                                                  {"--limit-s", "nan"},
                                                                  {"--max-ate-m", "0"}})
        EXPECT_EQ(study(folder, more).exitCode, 2) << more[0];
    EXPECT_EQ(study(folder, {"--backends", "ekf,ekf"}).exitCode, 2);
    EXPECT_EQ(runProcess({program("salma-eval"), "montecarlo", kConfig}).exitCode, 2);
    const auto help = runProcess({program("salma-eval"), "montecarlo", "--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.output.find("Examples:\n  salma-eval montecarlo "), 0u) << help.output;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace salma::test
