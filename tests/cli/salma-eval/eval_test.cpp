// SPDX-License-Identifier: BSD-3-Clause
#include <CProcess.h>
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

namespace salma::test {
namespace {

using nlohmann::json;

TProcessResult eval(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program("salma-eval"));
    return runProcess(arguments);
}

constexpr auto kReference = "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 2 0 0 0 0 0 1\n3 3 0 0 0 0 0 1\n";
constexpr auto kEstimate =
    "0 7 0.1 0 0 0 0 1\n1 8 -0.1 0 0 0 0 1\n2 9 -0.1 0 0 0 0 1\n3 10 0.1 0 0 0 0 1\n9 0 0 0 0 0 0 "
    "1\n";

/// Two posters, one corner; the robot stands at the origin and looks along x.
constexpr auto kLandmarks =
    "id,kind,x_m,y_m,z_m,yaw_deg,width_m,height_m,texture\n"
    "1,salient,4,1,1.5,180,0.6,0.4,a.jpg\n2,salient,4,-1,1.5,180,0.6,0.4,b.jpg\n"
    "3,corner,2,0,0.3,,,,\n";
constexpr auto kSightings =
    "t_s,landmark_id,u_px,v_px,range_m,bearing_deg\n"
    "10.000000,1,100,200,4,14\n10.000000,2,500,200,4,-14\n10.000000,3,,,2,0\n"
    "11.000000,1,110,200,4,14\n11.000000,2,510,200,4,-14\n12.000000,1,120,200,4,14\n";
constexpr auto kPath =
    "9 0 0 0 0 0 0 1\n9.5 0 0 0 0 0 0 1\n10 0 0 0 0 0 0 1\n10.5 0 0 0 0 0 0 1\n"
    "11 0 0 0 0 0 0 1\n11.5 0 0 0 0 0 0 1\n12 0 0 0 0 0 0 1\n";
/// Poster 1 again rightly, poster 2 taken for poster 1, poster 1 made twice, a false entity.
constexpr auto kAssociations =
    "t_s,observation,kind,range_m,bearing_deg,u_px,v_px,decision,landmark_id,d2,log_lr,"
    "n_candidates,reason\n"
    "10.000000,0,salient,4,14,105,205,new,0,,,0,unexplained\n"
    "10.000000,1,salient,4,-14,490,205,new,1,,,0,unexplained\n"
    "10.000000,2,corner,2,0,,,new,2,,,0,unexplained\n"
    "11.000000,0,salient,4,14,112,203,paired,0,1.5,8,1,nearest\n"
    "11.000000,1,salient,4,-14,505,199,paired,0,2.5,1,2,nearest\n"
    "11.000000,2,salient,6,40,300,20,new,4,,,0,unexplained\n"
    "11.000000,3,corner,2.1,0,,,paired,2,0.5,,1,nearest\n"
    "12.000000,0,salient,4,14,121,201,new,5,,,0,unexplained\n";

/// A folder with "truth" and "run".
struct TPair {
    TPair() {
        folder.write("truth/loop.landmarks.csv", kLandmarks);
        folder.write("truth/loop.sightings.csv", kSightings);
        folder.write("truth/loop.gt.tum", kPath);
        folder.write("run/associations.csv", kAssociations);
    }
    TProcessResult score(std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments{"associations", (folder / "truth").string(),
                                           (folder / "run").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return eval(arguments);
    }
    CTemporaryFolder folder;
};

TEST(SalmaEval, StartsItsHelpWithTwoExamplesAndRefusesMisuse) {
    const auto help = eval({"--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.output.rfind("Examples:\n  salma-eval trajectory ", 0), 0U);
    EXPECT_NE(help.output.find("\n  salma-eval associations "), std::string::npos);
    EXPECT_EQ(eval({"--version"}).exitCode, 0);
    EXPECT_EQ(eval({"--print-config"}).exitCode, 0);
    EXPECT_EQ(eval({}).exitCode, 2);
    EXPECT_EQ(eval({"trajectory", "a.tum"}).exitCode, 2);
    EXPECT_EQ(eval({"trajectory", "a.tum", "b.tum", "--delta-m", "0"}).exitCode, 2);
    EXPECT_EQ(eval({"trajectory", "a.tum", "b.tum", "--delta-m", "nan"}).exitCode, 2);
    EXPECT_EQ(eval({"relations", "a", "b"}).exitCode, 2);
    EXPECT_EQ(eval({"trajectory", "a.tum", "b.tum", "--frobnicate"}).exitCode, 2);
}

TEST(SalmaEval, ScoresATrajectoryAsOneDoesByHand) {
    const CTemporaryFolder folder;
    const auto reference = folder.write("r.tum", kReference);
    const auto estimate = folder.write("e.tum", kEstimate);
    const auto result = eval({"trajectory", reference, estimate, "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto scores = json::parse(result.output);
    EXPECT_EQ(scores["pairs"], 4);
    EXPECT_EQ(scores["unmatched"], 1);
    EXPECT_NEAR(scores["ate_aligned"]["rmse_m"], 0.1, 1e-9);
    EXPECT_NEAR(scores["ate_unaligned"]["rmse_m"], std::sqrt(49.01), 1e-9);
    EXPECT_NEAR(scores["rpe_distance"]["translation"]["max_m"], 0.2, 1e-9);
    EXPECT_NEAR(scores["alignment"]["x_m"], -7, 1e-9);
    const auto table = eval({"trajectory", reference, estimate});
    EXPECT_NE(table.output.find("4 poses compared, 1 without a reference"), std::string::npos);
}

TEST(SalmaEval, WritesTheScoresIntoAFolderAndKeepsWhatIsThere) {
    const CTemporaryFolder folder;
    const auto reference = folder.write("r.tum", kReference);
    const auto estimate = folder.write("e.tum", kEstimate);
    const std::string out = (folder / "out").string();
    EXPECT_EQ(eval({"trajectory", reference, estimate, "--out", out}).exitCode, 0);
    EXPECT_EQ(json::parse(readFile(folder / "out/trajectory.json"))["pairs"], 4);
    const TPair pair;
    EXPECT_EQ(pair.score({"--out", out}).exitCode, 0);
    EXPECT_EQ(json::parse(readFile(folder / "out/associations.json"))["truth"], "loop");
    EXPECT_TRUE(std::filesystem::exists(folder / "out/trajectory.json"));
}

TEST(SalmaEval, CountsTheAssociationsOfARunMadeByHand) {
    const TPair pair;
    const auto result = pair.score({"--json"});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto scores = json::parse(result.output);
    const auto& salient = scores["salient"];
    EXPECT_EQ(salient["observations"], 6);
    EXPECT_EQ(salient["false_entities"], 1);
    EXPECT_EQ(salient["precision"]["count"], 1);
    EXPECT_EQ(salient["precision"]["total"], 2);
    EXPECT_EQ(salient["recall"]["count"], 1);
    EXPECT_EQ(salient["recall"]["total"], 3);
    EXPECT_EQ(salient["wrong_pairings"], 1);
    EXPECT_EQ(salient["wrong"][0], json({{"t_s", 11.0},
                                         {"observation", 1},
                                         {"true_id", 2},
                                         {"landmark_id", 0},
                                         {"landmark_true_id", 1}}));
    EXPECT_EQ(salient["landmarks_made"], 4);
    EXPECT_EQ(salient["landmarks_true"], 2);
    EXPECT_EQ(salient["landmarks_covered"], 2);
    EXPECT_EQ(salient["duplicates"], 1);
    EXPECT_EQ(salient["duplicated"][0]["landmark_ids"], json({0, 5}));
    EXPECT_EQ(salient["false_landmarks"], 1);
    EXPECT_EQ(scores["corners"]["precision"]["count"], 1);
    EXPECT_EQ(scores["corners"]["recall"]["total"], 1);
    const auto table = pair.score();
    EXPECT_NE(table.output.find("1 of 2 = 50.0 % (95 %: 1.3 to 98.7)"), std::string::npos)
        << table.output;
    EXPECT_NE(table.output.find("true 1 is in the map as landmarks 0 5"), std::string::npos);
}

TEST(SalmaEval, ScoresNoCornersWithoutTheTruePath) {
    const TPair pair;
    std::filesystem::remove(pair.folder / "truth/loop.gt.tum");
    const auto result = pair.score({"--json"});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_TRUE(json::parse(result.output)["corners"].is_null());
}

TEST(SalmaEval, AsksForTheNameWhereAFolderHoldsSeveralTruths) {
    const TPair pair;
    pair.folder.write("truth/other.sightings.csv", kSightings);
    const auto result = pair.score();
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.output.find("choose with --name"), std::string::npos);
    EXPECT_EQ(pair.score({"--name", "loop"}).exitCode, 0);
    EXPECT_EQ(pair.score({"--name", "other"}).exitCode, 1) << "it has no landmarks";
}

/// The message of a run that must fail with one line.
std::string failure(const TProcessResult& result) {
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    return result.output;
}

TEST(SalmaEval, NamesFileAndLineOfAMalformedInput) {
    const CTemporaryFolder folder;
    const auto reference = folder.write("r.tum", kReference);
    const auto bad = folder.write("bad.tum", "0 0 0 0 0 0 0 1\n1 x 0 0 0 0 0 1\n");
    EXPECT_NE(failure(eval({"trajectory", reference, bad})).find("bad.tum:2: 'x'"),
              std::string::npos);
    EXPECT_NE(failure(eval({"trajectory", reference, "no-such.tum"})).find("no-such.tum"),
              std::string::npos);
    const TPair pair;
    pair.folder.write(
        "run/associations.csv",
        std::string(kAssociations) + "13,0,salient,4,14,1,2,perhaps,0,1,1,1,nearest\n");
    EXPECT_NE(failure(pair.score()).find("associations.csv:10: decision = 'perhaps' is not known"),
              std::string::npos);
    pair.folder.write("truth/loop.sightings.csv",
                      std::string(kSightings) + "13.000000,77,1,2,3,4\n");
    EXPECT_NE(failure(pair.score()).find("loop.sightings.csv:8: landmark_id = '77'"),
              std::string::npos);
}

TEST(SalmaEval, SaysWhatIsMissing) {
    const TPair pair;
    const std::string truth = (pair.folder / "truth").string();
    const std::string run = (pair.folder / "run").string();
    EXPECT_NE(failure(eval({"associations", truth, truth})).find("associations.csv"),
              std::string::npos);
    EXPECT_NE(failure(eval({"associations", run, run})).find("holds no truth"), std::string::npos);
    EXPECT_NE(failure(eval({"associations", "/no/such", run})).find("no such folder"),
              std::string::npos);
}

TEST(SalmaEval, ScoresOrRefusesAnyDamagedTableInOneLine) {
    const TPair pair;
    std::mt19937 random(3);
    for (int i = 0; i < 25; ++i) {
        std::string text = kAssociations;
        text[random() % text.size()] = static_cast<char>(random() % 256);
        if (i % 3 == 0) text.resize(random() % text.size());
        pair.folder.write("run/associations.csv", text);
        const auto result = pair.score();
        if (result.exitCode != 0) failure(result);
    }
}

}  // namespace
}  // namespace salma::test
