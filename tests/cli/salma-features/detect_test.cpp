// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/CAffineSaliency.h>
#include <salma/saliency/CGreedyClusterer.h>
#include <salma/saliency/CScaleSaliency.h>
#include <salma/saliency/regionFiles.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "CProcess.h"
#include "CTemporaryFolder.h"

namespace salma {
namespace {

namespace fs = std::filesystem;
using test::CTemporaryFolder;
using test::readFile;
using test::TProcessResult;

TProcessResult detect(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{test::program("salma-features"), "detect"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return test::runProcess(command);
}

void expectOneLineError(const TProcessResult& result, const std::string& part) {
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_EQ(result.output.find("salma-features: "), 0u) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

void expectUsageError(const TProcessResult& result, const std::string& part) {
    EXPECT_EQ(result.exitCode, 2) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
}

/// Coloured squares of several sizes on a light wall.
cv::Mat poster() {
    cv::Mat picture(120, 160, CV_8UC3, cv::Scalar(210, 215, 220));
    cv::RNG random(3);
    for (int i = 0; i < 60; ++i) {
        const int size = random.uniform(4, 14);
        const cv::Rect square(random.uniform(45, 110), random.uniform(35, 75), size, size);
        picture(square).setTo(
            cv::Scalar(random.uniform(0, 256), random.uniform(0, 256), random.uniform(0, 256)));
    }
    return picture;
}

/// The poster as a file of `folder`, without loss.
std::string posterFile(const CTemporaryFolder& folder, const std::string& name = "poster.png") {
    const std::string file = (folder / name).string();
    EXPECT_TRUE(cv::imwrite(file, poster()));
    return file;
}

std::vector<std::string> linesOf(const fs::path& file) {
    std::vector<std::string> lines;
    std::istringstream text(readFile(file));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

TEST(SalmaFeaturesDetect, WritesTheRegionsOfTheLibraryInAllItsFiles) {
    const CTemporaryFolder folder;
    const std::string file = posterFile(folder);
    const auto result = detect({file, "--out", (folder / "out").string(), "--peaks"});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto peaks = saliency::CScaleSaliency().detect(cv::imread(file, cv::IMREAD_GRAYSCALE));
    const auto regions = saliency::CGreedyClusterer().cluster(peaks).regions;
    ASSERT_FALSE(regions.empty());
    const auto peakLines = linesOf(folder / "out/poster.peaks.csv");
    EXPECT_EQ(peakLines[0], "x_px,y_px,scale_px,entropy,interscale,saliency");
    EXPECT_EQ(peakLines.size(), peaks.size() + 1);
    const auto regionLines = linesOf(folder / "out/poster.regions.csv");
    ASSERT_EQ(regionLines.size(), regions.size() + 1);
    EXPECT_EQ(regionLines[0], peakLines[0]);
    double x = 0, y = 0, s = 0, H = 0, W = 0, Y = 0;
    ASSERT_EQ(
        std::sscanf(regionLines[1].c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &x, &y, &s, &H, &W, &Y), 6);
    EXPECT_EQ(std::make_tuple(x, y, s), std::make_tuple(regions[0].x, regions[0].y, regions[0].s));
    EXPECT_NEAR(Y, regions[0].Y, 1e-8);
    const auto discs = saliency::readVgg((folder / "out/poster.vgg").string());
    ASSERT_EQ(discs.size(), regions.size());
    EXPECT_NEAR(discs[0].radius(), regions[0].s, 1e-6);
    EXPECT_EQ(result.output, "poster: 160x120, " + std::to_string(peaks.size()) + " peaks, " +
                                 std::to_string(regions.size()) + " regions\n");
}

TEST(SalmaFeaturesDetect, DrawsTheStrongestRegionInRed) {
    const CTemporaryFolder folder;
    const std::string file = posterFile(folder);
    ASSERT_EQ(detect({file, "--out", (folder / "out").string()}).exitCode, 0);
    EXPECT_FALSE(fs::exists(folder / "out/poster.peaks.csv"));
    const auto discs = saliency::readVgg((folder / "out/poster.vgg").string());
    const cv::Mat overlay = cv::imread((folder / "out/poster.overlay.png").string());
    ASSERT_EQ(overlay.size(), cv::Size(160, 120));
    int red = 0;  // of the four ends of its axes; a number may hide one
    for (const auto& [dx, dy] : {std::pair{0, -1}, {1, 0}, {0, 1}, {-1, 0}}) {
        const double r = discs[0].radius();
        const auto pixel =
            overlay.at<cv::Vec3b>(cv::Point(cv::Point2d(discs[0].u + r * dx, discs[0].v + r * dy)));
        if (pixel[2] > 200 && pixel[0] < 60 && pixel[1] < 60) ++red;
    }
    EXPECT_GE(red, 2);
}

TEST(SalmaFeaturesDetect, LeavesOutRegionsBelowYMin) {
    const CTemporaryFolder folder;
    const std::string file = posterFile(folder);
    ASSERT_EQ(detect({file, "--out", (folder / "all").string()}).exitCode, 0);
    ASSERT_EQ(detect({file, "--out", (folder / "few").string(), "--y-min", "1.2"}).exitCode, 0);
    auto expected = linesOf(folder / "all/poster.regions.csv");
    const auto isWeak = [](const std::string& line) {
        return line[0] != 'x' && std::stod(line.substr(line.rfind(',') + 1)) < 1.2;
    };
    const std::size_t all = expected.size();
    expected.erase(std::remove_if(expected.begin(), expected.end(), isWeak), expected.end());
    ASSERT_LT(expected.size(), all);
    ASSERT_GT(expected.size(), 1u);
    EXPECT_EQ(linesOf(folder / "few/poster.regions.csv"), expected);
}

TEST(SalmaFeaturesDetect, WritesTheEllipsesOfTheLibraryIfAskedByFlagOrIni) {
    const CTemporaryFolder folder;
    const std::string file = posterFile(folder);
    const std::string ini = folder.write(
        "kadir.ini", "[clustering]\nmethod = kadir\nmax_variance_px2 = 4\n[affine]\nuse = true\n");
    const std::string alsoFlag =
        folder.write("flag.ini", "[clustering]\nmethod = kadir\nmax_variance_px2 = 4\n");
    const std::string out = (folder / "out").string();
    const auto result = detect({file, "--out", out, "--config", ini});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const std::string again = (folder / "again").string();
    ASSERT_EQ(detect({file, "--out", again, "--config", alsoFlag, "--affine"}).exitCode, 0);
    for (const std::string name : {"/poster.vgg", "/poster.regions.csv"})
        EXPECT_EQ(readFile(out + name), readFile(again + name));

    const cv::Mat grey = cv::imread(file, cv::IMREAD_GRAYSCALE);
    saliency::TClusteringOptions clustering;
    clustering.method = saliency::EClustering::kadir;
    clustering.maxVariance = 4;
    const auto discs =
        saliency::createClusterer(clustering)->cluster(saliency::CScaleSaliency().detect(grey));
    auto expected = saliency::CAffineSaliency().adapt(grey, discs.regions);
    std::stable_sort(expected.regions.begin(), expected.regions.end(),
                     [](const auto& a, const auto& b) { return a.Y > b.Y; });
    const auto ellipses = saliency::readVgg(out + "/poster.vgg");
    const auto lines = linesOf(out + "/poster.regions.csv");
    ASSERT_EQ(ellipses.size(), expected.regions.size());
    ASSERT_EQ(lines.size(), ellipses.size() + 1);
    ASSERT_GT(ellipses.size(), 5u);
    for (std::size_t i = 0; i < ellipses.size(); ++i) {
        const auto& e = expected.regions[i];
        EXPECT_NEAR(ellipses[i].a, e.ellipse.a, 1e-9 * e.ellipse.a);
        EXPECT_NEAR(ellipses[i].b, e.ellipse.b, 1e-9);
        double x = 0, y = 0, s = 0, H = 0, W = 0, Y = 0;
        ASSERT_EQ(
            std::sscanf(lines[i + 1].c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &x, &y, &s, &H, &W, &Y),
            6);
        EXPECT_NEAR(s, ellipses[i].radius(), 1e-6);
        EXPECT_NEAR(Y, e.Y, 1e-8);
    }
    EXPECT_TRUE(std::any_of(ellipses.begin(), ellipses.end(),
                            [](const auto& e) { return std::abs(e.b) > 1e-4; }));
    EXPECT_NE(result.output.find(" of them adapted to ellipses\n"), std::string::npos);
    EXPECT_NE(readFile(out + "/poster.overlay.png"), "");
}

TEST(SalmaFeaturesDetect, WritesStableRegionsWithTheirPolarity) {
    const CTemporaryFolder folder;
    cv::Mat picture(100, 100, CV_8UC1, cv::Scalar(220));
    picture(cv::Rect(30, 40, 30, 15)).setTo(20);
    const std::string file = (folder / "plate.png").string();
    cv::imwrite(file, picture);
    const auto result = detect({file, "--out", (folder / "out").string(), "--detector", "mser"});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto lines = linesOf(folder / "out/plate.regions.csv");
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[1].substr(0, 8), "44.5,47,");
    const std::string end = ",,,,450,20,dark";  // no entropies; 30x15 pixels of grey 20
    EXPECT_EQ(lines[1].substr(lines[1].size() - end.size()), end);
    EXPECT_TRUE(fs::exists(folder / "out/plate.overlay.png"));
}

TEST(SalmaFeaturesDetect, WritesBothKindsOfRegionsBesideEachOther) {
    const CTemporaryFolder folder;
    const std::string file = posterFile(folder);
    for (const std::string detector : {"both", "scale-saliency", "mser"}) {
        const auto result =
            detect({file, "--out", (folder / detector).string(), "--detector", detector});
        ASSERT_EQ(result.exitCode, 0) << result.output;
    }
    for (const std::string name : {"regions.csv", "vgg", "overlay.png"}) {
        EXPECT_EQ(readFile(folder / ("both/poster." + name)),
                  readFile(folder / ("scale-saliency/poster." + name)));
        EXPECT_EQ(readFile(folder / ("both/poster.stable." + name)),
                  readFile(folder / ("mser/poster." + name)));
    }
}

TEST(SalmaFeaturesDetect, WritesTheCornersOfQuadrilaterals) {
    const CTemporaryFolder folder;
    cv::Mat picture(200, 200, CV_8UC1, cv::Scalar(220));
    picture(cv::Rect(40, 60, 100, 70)).setTo(20);
    const std::string file = (folder / "plate.png").string();
    cv::imwrite(file, picture);
    const auto result = detect({file, "--out", (folder / "out").string(), "--detector", "quad"});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(result.output, "plate: 200x200, 1 quadrilaterals\n");
    const auto lines = linesOf(folder / "out/plate.quads.csv");
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0], "x0_px,y0_px,x1_px,y1_px,x2_px,y2_px,x3_px,y3_px,area_px2");
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0, x2 = 0, y2 = 0, x3 = 0, y3 = 0, area = 0;
    ASSERT_EQ(std::sscanf(lines[1].c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &x0, &y0, &x1,
                          &y1, &x2, &y2, &x3, &y3, &area),
              9);
    for (const auto& [found, expected] : {std::pair{x0, 40.0},
                                          {y0, 60.0},
                                          {x1, 140.0},
                                          {y1, 60.0},
                                          {x2, 140.0},
                                          {y2, 130.0},
                                          {x3, 40.0},
                                          {y3, 130.0}})
        EXPECT_NEAR(found, expected, 4);
    EXPECT_NEAR(area, 7000, 700);
    EXPECT_TRUE(fs::exists(folder / "out/plate.overlay.png"));
}

TEST(SalmaFeaturesDetect, ReadsItsSectionsOfAWholeConfigFile) {
    const CTemporaryFolder folder;
    const std::string file = posterFile(folder);
    const std::string config =
        folder.write("my.ini", "[run]\nanything = 1\n[saliency]\nscale_max_px = 10\n");
    ASSERT_EQ(detect({file, "--out", (folder / "out").string(), "--config", config}).exitCode, 0);
    const auto lines = linesOf(folder / "out/poster.regions.csv");
    ASSERT_GT(lines.size(), 1u);
    for (const auto& disc : saliency::readVgg((folder / "out/poster.vgg").string()))
        EXPECT_LT(disc.radius(), 9.5);
    const auto printed = detect({"--print-config", "--config", config});
    EXPECT_EQ(printed.exitCode, 0);
    EXPECT_NE(printed.output.find("scale_max_px             = 10"), std::string::npos);
    EXPECT_NE(printed.output.find("[mser]"), std::string::npos);
    const std::string wrong = folder.write("wrong.ini", "[saliency]\nscale_maxpx = 10\n");
    expectOneLineError(detect({file, "--out", (folder / "no").string(), "--config", wrong}),
                       "scale_maxpx");
    EXPECT_FALSE(fs::exists(folder / "no"));
}

TEST(SalmaFeaturesDetect, AddsToAFolderOfResults) {
    const CTemporaryFolder folder;
    const std::string out = (folder / "out").string();
    ASSERT_EQ(detect({posterFile(folder, "a.png"), "--out", out}).exitCode, 0);
    ASSERT_EQ(detect({posterFile(folder, "b.png"), "--out", out}).exitCode, 0);
    EXPECT_EQ(readFile(folder / "out/a.regions.csv"), readFile(folder / "out/b.regions.csv"));
}

TEST(SalmaFeaturesDetect, SaysThatAPictureIsSmallerThanTheWindow) {
    const CTemporaryFolder folder;
    const std::string file = (folder / "dot.png").string();
    cv::imwrite(file, cv::Mat(1, 1, CV_8UC1, cv::Scalar(9)));
    const auto result = detect({file, "--out", (folder / "out").string()});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.output, "dot: 1x1, 0 peaks, 0 regions (smaller than the window of 67 px)\n");
    EXPECT_EQ(readFile(folder / "out/dot.vgg"), "1.0\n0\n");
}

TEST(SalmaFeaturesDetect, NamesThePictureItCannotReadAndWritesNothing) {
    const CTemporaryFolder folder;
    const std::string good = posterFile(folder);
    const std::string out = (folder / "out").string();
    cv::Mat deep(80, 80, CV_16UC1, cv::Scalar(1000));
    cv::imwrite((folder / "deep.png").string(), deep);
    cv::imwrite((folder / "whole.jpg").string(), poster());
    for (const std::string& whole : {good, (folder / "whole.jpg").string()}) {
        const std::string text = readFile(whole);
        const std::string half =
            folder.write("half" + fs::path(whole).extension().string(), text.substr(0, 2000));
        const auto result = detect({half, "--out", out});
        expectOneLineError(result, half + ": is a picture that breaks off");
    }
    const std::string missing = (folder / "missing.png").string();
    expectOneLineError(detect({missing, "--out", out}), missing);
    const std::string text = folder.write("text.png", "no picture");
    expectOneLineError(detect({text, "--out", out}), text + ": cannot be read as a picture");
    expectOneLineError(detect({folder.write("empty.png", ""), "--out", out}), "empty.png");
    expectOneLineError(detect({folder.path().string(), "--out", out}), "not a file");
    expectOneLineError(detect({(folder / "deep.png").string(), "--out", out}),
                       "deep.png: has more than 8 bits for each channel");
    EXPECT_EQ(detect({good, missing, "--out", out}).exitCode, 1);
    EXPECT_FALSE(fs::exists(out));
}

TEST(SalmaFeaturesDetect, RefusesTwoPicturesWhoseResultsWouldHaveOneName) {
    const CTemporaryFolder folder;
    const std::string first = posterFile(folder);
    const std::string second = folder.write("other/poster.jpg", "never read");
    expectOneLineError(detect({first, second, "--out", (folder / "out").string()}),
                       first + " and " + second + ": results of both would be named poster");
}

TEST(SalmaFeaturesDetect, LeavesAFolderAloneThatItDidNotWrite) {
    const CTemporaryFolder folder;
    folder.write("mine/letter.txt", "dear");
    const std::string mine = (folder / "mine").string();
    expectOneLineError(detect({posterFile(folder), "--out", mine}), mine);
    EXPECT_EQ(readFile(folder / "mine/letter.txt"), "dear");
}

TEST(SalmaFeaturesDetect, RefusesMisuseWithCodeTwo) {
    expectUsageError(detect({}), "IMAGE is required");
    expectUsageError(detect({"a.png"}), "--out is required");
    expectUsageError(detect({"a.png", "--out", "x", "--colour"}), "--colour");
    expectUsageError(detect({"a.png", "--out", "x", "--detector", "sift"}), "sift");
    expectUsageError(detect({"a.png", "--out", "x", "--y-min", "-1"}), "--y-min");
    expectUsageError(detect({"a.png", "--out", "x", "--y-min", "nan"}), "--y-min");
    expectUsageError(detect({"a.png", "--out", "x", "--detector", "mser", "--peaks"}), "peaks");
    expectUsageError(detect({"a.png", "--out", "x", "--detector", "mser", "--affine"}), "affine");
    expectUsageError(detect({"a.png", "--out", "x", "--detector", "quad", "--peaks"}), "peaks");
}

TEST(SalmaFeaturesDetect, BeginsItsHelpWithExamples) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--help"}, {"detect", "--help"}}) {
        std::vector<std::string> command{test::program("salma-features")};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const auto result = test::runProcess(command);
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_EQ(result.output.find("Examples:\n  salma-features "), 0u) << result.output;
    }
}

TEST(SalmaFeaturesDetect, TakesTheRegionsOfAnotherProgram) {
    const CTemporaryFolder folder;
    const std::string program =
        folder.write("regions.sh", "#!/bin/sh\nprintf '1.0\\n1\\n40 30 0.01 0 0.04\\n' > \"$2\"\n");
    fs::permissions(program, fs::perms::owner_all);
    const auto ini =
        folder.write("my.ini", "[external]\ncommand = " + program + " {image} {regions}\n");
    const auto result = detect({posterFile(folder), "--detector", "external", "--config", ini,
                                "--out", (folder / "out").string()});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("poster: 160x120, 1 regions"), std::string::npos) << result.output;
    EXPECT_EQ(readFile(folder / "out/poster.vgg"), "1.0\n1\n40 30 0.01 0 0.04\n");
    EXPECT_TRUE(fs::exists(folder / "out/poster.overlay.png"));
}

TEST(SalmaFeaturesDetect, SaysWhatBecameOfAnotherProgramThatFails) {
    const CTemporaryFolder folder;
    const auto with = [&](const std::string& section) {
        return detect({posterFile(folder), "--detector", "external", "--config",
                       folder.write("my.ini", "[external]\n" + section), "--out",
                       (folder / "out").string()});
    };
    expectOneLineError(with(""), "needs a command in [external]");
    expectOneLineError(with("command = no-such-program {image} {regions}\n"),
                       "external detector 'no-such-program' cannot be started");
    expectOneLineError(with("command = sleep 100 {image} {regions}\ntime_limit_s = 0.2\n"),
                       "sleep");
    expectOneLineError(with("command = cp {image} {regions}\n"),
                       "wrote no good region file, line:1:");
    expectOneLineError(with("command = true {image}\n"), "lacks {regions}");
    EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace salma
