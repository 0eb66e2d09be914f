// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/regionFiles.h>
#include <salma/viz/CCsvTable.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "CProcess.h"
#include "CTemporaryFolder.h"
#include "TDetector.h"
#include "TPictureSet.h"

namespace salma::bench {
namespace {

namespace fs = std::filesystem;
using test::CTemporaryFolder;
using test::TProcessResult;

constexpr auto kIdentity = "1 0 0\n0 1 0\n0 0 1\n";

TProcessResult run(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{SALMA_BINARY_DIR "/bench/region-repeatability"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return test::runProcess(command);
}

void expectOneLineError(const TProcessResult& result, const std::string& part) {
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_EQ(result.output.find("region-repeatability: "), 0u) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

/// Squares and discs of several sizes, a little out of focus.
cv::Mat texture() {
    cv::Mat picture(220, 260, CV_8UC1, cv::Scalar(128));
    cv::RNG random(4);
    for (int i = 0; i < 150; ++i) {
        const int size = random.uniform(3, 14);
        const cv::Point place(random.uniform(0, 260), random.uniform(0, 220));
        const cv::Scalar grey(random.uniform(0, 256));
        if (i % 2 == 0)
            cv::circle(picture, place, size, grey, cv::FILLED);
        else
            cv::rectangle(picture, cv::Rect(place, cv::Size(2 * size, size)), grey, cv::FILLED);
    }
    cv::GaussianBlur(picture, picture, {0, 0}, 1.2);
    return picture;
}

void write(const fs::path& file, const cv::Mat& picture) {
    ASSERT_TRUE(cv::imwrite(file.string(), picture));
}

/// The texture, the same again, and a little turned and smaller: named as VGG names them.
void writeSet(const CTemporaryFolder& folder, const std::string& name) {
    fs::create_directories(folder / name);
    write(folder / name / "img1.pgm", texture());
    write(folder / name / "img2.png", texture());
    cv::Mat turned;
    cv::warpAffine(texture(), turned, cv::Mat(cv::Matx23d(0.88, 0.15, 10, -0.15, 0.88, 35)),
                   {260, 240}, cv::INTER_AREA);
    cv::cvtColor(turned, turned, cv::COLOR_GRAY2BGR);
    write(folder / name / "img3.ppm", turned);
    folder.write(name + "/H1to2p", kIdentity);
    folder.write(name + "/H1to3p", "0.88 0.15 10\n-0.15 0.88 35\n0 0 1\n");
}

/// Detector and operating point to repeatability, of picture 1 and `picture`.
std::map<std::string, double> ratesOf(const fs::path& csv, int picture) {
    const viz::CCsvTable table(
        csv.string(), {"set", "detector", "point", "picture", "scale", "stretch", "first_regions",
                       "second_regions", "first_common", "second_common", "correspondences",
                       "repeatability", "first_nonredundant", "second_nonredundant",
                       "nonredundant_correspondences", "nonredundant_repeatability", "chance"});
    std::map<std::string, double> rates;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.integer(row, "picture") != picture) continue;
        EXPECT_GT(table.integer(row, "correspondences"), 3);
        EXPECT_LT(table.number(row, "chance"), 0.8 * table.number(row, "repeatability"));
        EXPECT_LE(table.number(row, "nonredundant_correspondences"),
                  table.number(row, "correspondences") + 1e-3);
        rates[table.text(row, "detector") + " " + table.text(row, "point")] =
            table.number(row, "repeatability");
    }
    return rates;
}

TEST(repeatabilityBench, MeasuresAllDetectorsAtBothPoints) {
    const CTemporaryFolder folder;
    writeSet(folder, "wall");
    const fs::path out = folder / "out";
    const auto result =
        run({(folder / "wall").string(), "--strongest", "80", "--out", out.string()});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto same = ratesOf(out / "repeatability.csv", 2);
    EXPECT_EQ(same.size(), 2 * allDetectors().size());
    for (const auto& [name, rate] : same) EXPECT_EQ(rate, 1) << name;
    for (const auto& [name, rate] : ratesOf(out / "repeatability.csv", 3)) {
        EXPECT_GT(rate, 0.25) << name;
        EXPECT_LT(rate, 1) << name;
    }
    for (const char* picture : {"wall.png", "sets.png"})
        EXPECT_FALSE(cv::imread((out / picture).string()).empty());
    const std::string tables = test::readFile(out / "repeatability.md");
    EXPECT_NE(tables.find("## wall\n"), std::string::npos) << tables;
    EXPECT_NE(tables.find("| salient, default | 100.0 ("), std::string::npos) << tables;
}

TEST(repeatabilityBench, WritesTheRegionsOfEachPictureForOtherPrograms) {
    const CTemporaryFolder folder;
    writeSet(folder, "wall");
    const fs::path out = folder / "out";
    ASSERT_EQ(
        run({(folder / "wall").string(), "--strongest", "40", "--out", out.string()}).exitCode, 0);
    for (const auto& detector : allDetectors()) {
        const fs::path regions = out / "regions/wall";
        const auto all = saliency::readVgg((regions / ("default/img1." + detector.name)).string());
        EXPECT_EQ(all.size(), detector.detect(texture(), std::nullopt).size());
        for (const char* picture : {"img1.", "img2.", "img3."}) {
            const auto few =
                saliency::readVgg((regions / "strongest" / (picture + detector.name)).string());
            EXPECT_EQ(few.size(), 40u);
        }
    }
}

TEST(repeatabilityBench, GivesTheSameForAnyNumberOfThreads) {
    const CTemporaryFolder folder;
    writeSet(folder, "wall");
    std::vector<std::string> tables;
    for (const char* threads : {"1", "3"}) {
        const fs::path out = folder / threads;
        ASSERT_EQ(
            run({(folder / "wall").string(), "--threads", threads, "--out", out.string()}).exitCode,
            0);
        tables.push_back(test::readFile(out / "repeatability.csv"));
    }
    EXPECT_EQ(tables[0], tables[1]);
}

TEST(repeatabilityBench, TakesTheStrongestRegionsOfEachDetector) {
    for (const auto& detector : allDetectors()) {
        const auto all = detector.detect(texture(), std::nullopt);
        const auto few = detector.detect(texture(), 25);
        ASSERT_GT(all.size(), 40u) << detector.name;
        EXPECT_EQ(few.size(), 25u) << detector.name;
        EXPECT_EQ(detector.detect(texture(), all.size()).size(), all.size()) << detector.name;
        EXPECT_TRUE(detector.detect(cv::Mat(200, 200, CV_8UC1, cv::Scalar(9)), 25).empty());
    }
}

TEST(repeatabilityBench, ReadsSetsNamedAsHPatchesNamesThem) {
    const CTemporaryFolder folder;
    write(folder / "1.png", texture());
    write(folder / "2.png", texture());
    folder.write("H_1_2", "2 0 5\n0 2 6\n0 0 1\n");
    const auto set = readPictureSet(folder.path().string() + "/");
    EXPECT_EQ(set.name, folder.path().filename());
    ASSERT_EQ(set.pictures.size(), 2u);
    EXPECT_EQ(set.H_picture_first[0](2, 2), 1);
    EXPECT_EQ(set.H_picture_first[1](1, 2), 6);
}

TEST(repeatabilityBench, TellsHowTwoViewsDiffer) {
    const auto change = viewChange({1.5, 0, 3, 0, 0.5, 4, 0, 0, 1}, {100, 80});
    EXPECT_NEAR(change.scale, std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(change.stretch, 3, 1e-12);
}

TEST(repeatabilityBench, NamesTheFileThatIsMissingOrBroken) {
    const CTemporaryFolder folder;
    const std::string out = (folder / "out").string();
    const std::string set = (folder / "wall").string();
    expectOneLineError(run({set, "--out", out}), "wall: is not a folder");
    fs::create_directories(set);
    expectOneLineError(run({set, "--out", out}), "wall: holds no img1");
    write(folder / "wall/img1.png", texture());
    expectOneLineError(run({set, "--out", out}), "wall/img2.*: this picture is missing");
    write(folder / "wall/img3.png", texture());
    expectOneLineError(run({set, "--out", out}), "wall/img2.*: this picture is missing");
    folder.write("wall/img2.png", "no picture");
    expectOneLineError(run({set, "--out", out}), "wall/img2.png: cannot be read as a picture");
    write(folder / "wall/img2.png", texture());
    expectOneLineError(run({set, "--out", out}), "wall/H1to2p: cannot be read");
    folder.write("wall/H1to2p", "1 0 0\n0 1 0\n");
    expectOneLineError(run({set, "--out", out}), "wall/H1to2p:2: file ends after 2 of 3 rows");
    folder.write("wall/H1to2p", kIdentity);
    folder.write("wall/H1to3p", "1 0 0\n0 nan 0\n0 0 1\n");
    expectOneLineError(run({set, "--out", out}), "wall/H1to3p:2: 'nan' is not a finite number");
    folder.write("wall/H1to3p", "1 0 0\n2 0 0\n0 0 1\n");
    expectOneLineError(run({set, "--out", out}), "wall/H1to3p:3: the matrix that ends here is");
    EXPECT_FALSE(fs::exists(out));
    folder.write("wall/H1to3p", kIdentity);
    expectOneLineError(run({set, set + "/", "--out", out}), "another set is named wall too");
    fs::rename(set, folder / "w'all");
    expectOneLineError(run({(folder / "w'all").string(), "--out", out}),
                       "w'all: tables and figures cannot carry");
}

TEST(repeatabilityBench, RefusesWrongUse) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{},
          {"."},
          {".", "--out", "x", "--nonsense"},
          {".", "--out", "x", "--strongest", "0"},
          {".", "--out", "x", "--threads", "-1"},
          {".", "--out", "x", "--max-overlap-error", "1"},
          {".", "--out", "x", "--max-overlap-error", "nan"}})
        EXPECT_EQ(run(arguments).exitCode, 2);
    const auto help = run({"--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.output.find("Examples:\n  region-repeatability "), 0u) << help.output;
}

}  // namespace
}  // namespace salma::bench
