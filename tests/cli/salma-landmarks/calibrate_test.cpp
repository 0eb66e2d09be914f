// SPDX-License-Identifier: BSD-3-Clause
#include <CProcess.h>
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace salma::test {
namespace {

namespace fs = std::filesystem;

TProcessResult calibrate(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {program("salma-landmarks"), "calibrate"});
    return runProcess(arguments);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
}

/// Two short runs past two posters each, of different pictures; made once for all tests.
struct TRuns {
    TRuns() {
        // two-posters.ini in a finer picture, with posters that are seen again and again
        const std::string textures = SALMA_SOURCE_DIR "/share/textures/";
        std::string world = readFile(SALMA_SOURCE_DIR "/tests/data/worlds/two-posters.ini");
        world = replaced(world, "../../../share/textures/GreatWave", textures + "GreatWave");
        world = replaced(world, "../../../share/textures/HokusaiWomanHoldingFan",
                         textures + "KazusaSeaRoute");
        world = replaced(world, "width_m = 0.543", "width_m = 0.7");
        world = replaced(world, "height_m = 0.780", "height_m = 0.471");
        world = replaced(world, "640x480", "768x492");
        world = replaced(world, "points_m = 0 0  5 0", "points_m = 0 -0.3  4.5 -0.3");
        learn = simulate("learn", world);
        world = replaced(world, "GreatWave", "EjiriSuruga");
        report = simulate("report", replaced(world, "KazusaSeaRoute", "HokusaiBridge"));
    }
    std::string simulate(const std::string& name, const std::string& world) const {
        const auto file = folder.write(name + ".ini", world);
        const auto out = (folder / name).string();
        const auto made = runProcess({program("salma-sim"), file, "--out", out});
        EXPECT_EQ(made.exitCode, 0) << made.output;
        return out;
    }
    CTemporaryFolder folder;
    std::string learn, report;
};

const TRuns& runs() {
    static const TRuns made;  // removed when the test program ends
    return made;
}

/// A copy of the learning run whose tables may be damaged.
class CDamaged {
 public:
    CDamaged() { fs::copy(runs().learn, m_folder / "run", fs::copy_options::recursive); }
    std::string file(const std::string& ending) const {
        return (m_folder / ("run/learn" + ending)).string();
    }
    void write(const std::string& ending, const std::string& text) const {
        std::ofstream(file(ending), std::ios::binary) << text;
    }
    /// The program refuses the folder in one line with these words and leaves nothing.
    void expectRefused(const std::string& words) const {
        const auto out = m_folder / "out";
        const auto result = calibrate(
            {(m_folder / "run").string(), "--report", runs().report, "--out", out.string()});
        EXPECT_EQ(result.exitCode, 1) << result.output;
        const auto line = result.output.rfind("salma-landmarks: ");
        ASSERT_NE(line, std::string::npos) << result.output;
        EXPECT_NE(result.output.find(words, line), std::string::npos) << result.output;
        EXPECT_EQ(std::count(result.output.begin() + static_cast<std::ptrdiff_t>(line),
                             result.output.end(), '\n'),
                  1)
            << result.output;
        EXPECT_FALSE(fs::exists(out));
    }

 private:
    CTemporaryFolder m_folder;
};

TEST(SalmaLandmarks, StartsItsHelpWithTwoExamplesAndRefusesMisuse) {
    const auto help = runProcess({program("salma-landmarks"), "--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.output.rfind("Examples:\n  salma-landmarks calibrate ", 0), 0U) << help.output;
    const auto more = calibrate({"--help"});
    EXPECT_EQ(more.exitCode, 0);
    EXPECT_NE(more.output.find("Examples:\n  salma-landmarks calibrate "), std::string::npos);
    EXPECT_EQ(runProcess({program("salma-landmarks"), "--version"}).exitCode, 0);
    EXPECT_EQ(runProcess({program("salma-landmarks")}).exitCode, 2);
    EXPECT_EQ(runProcess({program("salma-landmarks"), "build"}).exitCode, 2);
    EXPECT_EQ(calibrate({}).exitCode, 2);
    EXPECT_EQ(calibrate({"somewhere"}).exitCode, 2) << "no --out";
    EXPECT_EQ(calibrate({"somewhere", "--frobnicate"}).exitCode, 2);
    const auto printed = calibrate({"--print-config"});
    EXPECT_EQ(printed.exitCode, 0);
    EXPECT_NE(printed.output.find("[calibrate]\nbins "), std::string::npos) << printed.output;
    EXPECT_NE(printed.output.find("\n[matcher]\n"), std::string::npos);
}

TEST(SalmaLandmarks, LearnsATableThatSalmaSlamReads) {
    const CTemporaryFolder folder;
    const auto out = folder / "out";
    const auto result = calibrate({runs().learn, "--report", runs().report, "--out", out.string()});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    for (const std::string name :
         {"calibration.ini", "calibration.json", "bins.csv", "pairs.csv", "reliability.csv",
          "decorrelation.csv", "detection.csv", "tables.png", "reliability.png"})
        EXPECT_GT(fs::file_size(out / name), 50U) << name;
    const auto figures = nlohmann::json::parse(readFile(out / "calibration.json"));
    EXPECT_EQ(figures["learning"]["posters"], 2);
    EXPECT_EQ(figures["report"]["posters"], 2);
    EXPECT_GT(figures["learning"]["pairs"]["same"], 3);
    EXPECT_GT(figures["learning"]["pairs"]["other"], 3);
    EXPECT_EQ(figures["learning"]["pairs"]["duplicate"], 0);
    EXPECT_GT(figures["report"]["learned"]["area_under_curve"]["value"], 0.8);
    EXPECT_LT(figures["report"]["learned"]["log_loss"]["value"], 0.69);
    // one pair of places, no duplicate: half a pair of two
    EXPECT_NEAR(figures["duplicate_rate"]["value"], 0.25, 0.05);

    for (const std::string kind : {"posters", "corners"}) {
        const auto& views = figures["report"]["detection"][kind];
        EXPECT_GT(views["found"], 3) << kind;
        EXPECT_GT(views["views"], views["found"]) << kind;
        EXPECT_LT(views["log_loss"]["learned"], 0.69) << kind << ": no worse than a coin";
    }

    const auto ini = (out / "calibration.ini").string();
    const auto read = runProcess({program("salma-slam"), ini, "--print-config"});
    EXPECT_EQ(read.exitCode, 0) << read.output;
    for (const std::string key : {"\nscore_knots ", "\nlog_lr_knots ", "\nkeypoint_log_lr_knots ",
                                  "\nby_incidence ", "\nby_range ", "\nby_corner_range "}) {
        const std::string text = readFile(ini);
        const auto from = text.find(key);
        ASSERT_NE(from, std::string::npos) << text;
        const auto line = text.substr(from, text.find('\n', from + 1) - from);
        EXPECT_NE(read.output.find(line), std::string::npos) << line;
    }
}

TEST(SalmaLandmarks, ShippedTablesAreTheDefaults) {
    const std::string learned = SALMA_SOURCE_DIR "/share/calibration.ini";
    const auto read = runProcess({program("salma-slam"), learned, "--print-config"});
    EXPECT_EQ(read.exitCode, 0) << read.output;
    EXPECT_EQ(read.output, runProcess({program("salma-slam"), "--print-config"}).output);
    for (const std::string key :
         {"\nduplicate_rate ", "\nscore_knots ", "\nlog_lr_knots ", "\nkeypoint_score_knots ",
          "\nkeypoint_log_lr_knots ", "\ndecorrelation_deg "})
        EXPECT_NE(readFile(learned).find(key), std::string::npos) << key;
}

TEST(SalmaLandmarks, LearnedTablesOfDetectionCanBeUsed) {
    const std::string learned = SALMA_SOURCE_DIR "/share/detection.ini";
    const auto read = runProcess({program("salma-slam"), learned, "--print-config"});
    EXPECT_EQ(read.exitCode, 0) << read.output;
    EXPECT_NE(read.output, runProcess({program("salma-slam"), "--print-config"}).output);
}

TEST(SalmaLandmarks, GivesTheSameTwiceAndTakesRecordsThatAreStored) {
    const CTemporaryFolder folder;
    const auto learn = [&](const std::string& from, const std::string& name) {
        const auto out = folder / name;
        const auto result = calibrate({from, "--report", runs().report, "--out", out.string()});
        EXPECT_EQ(result.exitCode, 0) << result.output;
        return readFile(out / "bins.csv") + readFile(out / "calibration.ini");
    };
    const auto first = learn(runs().learn, "one");
    EXPECT_EQ(learn(runs().learn, "two"), first);
    fs::copy(runs().learn, folder / "stored", fs::copy_options::recursive);
    const auto config = folder.write("slam.ini", "");
    const auto run = runProcess({program("salma-slam"), config, runs().learn + "/learn.rawlog",
                                 "--save-rawlog", "--out", (folder / "slam").string()});
    ASSERT_EQ(run.exitCode, 0) << run.output;
    fs::copy(folder / "slam/learn.salient.rawlog", folder / "stored/learn.salient.rawlog",
             fs::copy_options::overwrite_existing);
    fs::remove_all(folder / "stored/learn_Images");  // nothing is left to look at
    EXPECT_EQ(learn((folder / "stored").string(), "three"), first);
}

TEST(SalmaLandmarks, RefusesRunsThatSayNothing) {
    const CTemporaryFolder folder;
    const auto refused = [&](std::vector<std::string> arguments, const std::string& words) {
        const auto out = (folder / "out").string();
        arguments.insert(arguments.end(), {"--out", out});
        const auto result = calibrate(arguments);
        EXPECT_EQ(result.exitCode, 1) << result.output;
        EXPECT_NE(result.output.find(words), std::string::npos) << result.output;
        EXPECT_FALSE(fs::exists(out));
    };
    refused({runs().learn}, "one run alone says nothing about others");
    refused({runs().learn, runs().learn}, "is named twice");
    refused({runs().learn, (folder / "no").string()}, "no: no such folder");
    fs::create_directory(folder / "empty");
    refused({runs().learn, (folder / "empty").string()}, "empty: holds no truth");
    fs::copy(runs().learn, folder / "copy", fs::copy_options::recursive);
    refused({runs().learn, "--report", (folder / "copy").string()},
            "hangs in the learning runs too");
    refused({runs().learn, "--report", runs().report, "--config", (folder / "no.ini").string()},
            "no.ini");
    refused({runs().learn, "--report", runs().report, "--bins", "1"}, "bins");
    folder.write("mine/precious.txt", "keep me");
    const auto result =
        calibrate({runs().learn, "--report", runs().report, "--out", (folder / "mine").string()});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(readFile(folder / "mine/precious.txt"), "keep me");
}

TEST(SalmaLandmarks, NamesTheFileTheLineAndTheValueOfADamagedTruth) {
    const CDamaged run;
    const auto landmarks = readFile(run.file(".landmarks.csv"));
    const auto sightings = readFile(run.file(".sightings.csv"));
    run.write(".landmarks.csv", landmarks.substr(0, landmarks.find('\n') + 12));
    run.expectRefused("learn.landmarks.csv:2: ");
    run.write(".landmarks.csv", replaced(landmarks, "yaw_deg", "yaw"));
    run.expectRefused("learn.landmarks.csv:1: the header must be");
    run.write(".landmarks.csv", landmarks.substr(0, landmarks.find('\n') + 1));
    run.expectRefused("learn.sightings.csv:2: landmark_id");
    run.write(".sightings.csv", sightings.substr(0, sightings.find('\n') + 1));
    run.expectRefused("learn.landmarks.csv: holds no poster");
    run.write(".landmarks.csv", landmarks);
    run.expectRefused("learn.rawlog: none of its 2 posters was seen");
    const auto second = sightings.find('\n') + 1;
    run.write(".sightings.csv", sightings.substr(0, second) + "nan" + sightings.substr(second));
    run.expectRefused("learn.sightings.csv:2: t_s = 'nan");
    run.write(".sightings.csv", sightings);
    fs::remove(run.file(".gt.tum"));
    run.expectRefused("learn.gt.tum");
}

TEST(SalmaLandmarks, NamesTheRawlogThatIsMissingOrCut) {
    const CDamaged run;
    const auto log = readFile(run.file(".rawlog"));
    run.write(".rawlog", log.substr(0, log.size() / 2));
    run.expectRefused("learn.rawlog");
    fs::remove(run.file(".rawlog"));
    run.expectRefused("learn.rawlog");
}

TEST(SalmaLandmarks, NeedsPostersThatAreSeenTwiceAndDiffer) {
    const CDamaged run;
    // All sightings of the second poster gone: nothing is different any more.
    std::istringstream in(readFile(run.file(".sightings.csv")));
    std::string kept;
    const std::string id = "," +
                           readFile(run.file(".landmarks.csv"))
                               .substr(readFile(run.file(".landmarks.csv")).find('\n') + 1, 1) +
                           ",";
    for (std::string line; std::getline(in, line);)
        if (kept.empty() || line.find(id) != 17) kept += line + "\n";
    run.write(".sightings.csv", kept);
    run.expectRefused("no two different posters were seen in one run");
}

}  // namespace
}  // namespace salma::test
