// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "CProcess.h"
#include "CTemporaryFolder.h"

namespace salma {
namespace {

namespace fs = std::filesystem;
using test::CTemporaryFolder;
using test::TProcessResult;

TProcessResult match(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{test::program("salma-features"), "match"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return test::runProcess(command);
}

std::string lastLine(const std::string& text) {
    const std::string body = text.substr(0, text.find_last_not_of('\n') + 1);
    return body.substr(body.rfind('\n') + 1);
}

/// Squares at random places, and the same from a little to the side.
std::pair<std::string, std::string> twoViews(const CTemporaryFolder& folder) {
    cv::Mat a(240, 320, CV_8UC3, cv::Scalar(190, 200, 200));
    cv::RNG random(3);
    for (int i = 0; i < 200; ++i)
        a(cv::Rect(random.uniform(0, 290), random.uniform(0, 210), random.uniform(4, 30),
                   random.uniform(4, 30)))
            .setTo(
                cv::Scalar(random.uniform(0, 256), random.uniform(0, 256), random.uniform(0, 256)));
    cv::Mat b;
    const cv::Matx33d H(0.95, 0.05, 10, -0.05, 0.97, 15, 1e-4, 1e-4, 1);
    cv::warpPerspective(a, b, H, {300, 260});
    const std::pair<std::string, std::string> files{(folder / "a.png").string(),
                                                    (folder / "b.png").string()};
    EXPECT_TRUE(cv::imwrite(files.first, a) && cv::imwrite(files.second, b));
    return files;
}

TEST(SalmaFeaturesMatch, RecognisesAPictureFromTheSideAndDrawsThePairs) {
    const CTemporaryFolder folder;
    const auto [a, b] = twoViews(folder);
    const auto result = match({a, b, "--out", (folder / "out").string()});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    double score = 0, logLr = 0;
    char decision[16] = "";
    const std::string line = lastLine(result.output);
    ASSERT_EQ(
        std::sscanf(line.c_str(), "score %lf log_lr %lf decision %15s", &score, &logLr, decision),
        3)
        << line;
    EXPECT_EQ(std::string(decision), "same");
    EXPECT_GT(score, 0.6);
    EXPECT_GT(logLr, 2);
    const std::string table = test::readFile(folder / "out/MATCHES.csv");
    EXPECT_EQ(table.substr(0, table.find('\n')), "xa_px,ya_px,xb_px,yb_px");
    EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 20);
    EXPECT_EQ(cv::imread((folder / "out/OVERLAY.png").string()).size(), cv::Size(620, 260));
}

TEST(SalmaFeaturesMatch, IsUndecidedAboutAPlainPicture) {
    const CTemporaryFolder folder;
    const auto files = twoViews(folder);
    const std::string plain = (folder / "plain.png").string();
    cv::imwrite(plain, cv::Mat(100, 100, CV_8UC1, cv::Scalar(80)));
    const auto result = match({files.first, plain, "--out", (folder / "out").string()});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(lastLine(result.output), "score 0.000 log_lr 0.000 decision unknown");
    EXPECT_EQ(test::readFile(folder / "out/MATCHES.csv"), "xa_px,ya_px,xb_px,yb_px\n");
}

TEST(SalmaFeaturesMatch, NamesThePictureItCannotReadAndWritesNothing) {
    const CTemporaryFolder folder;
    const auto files = twoViews(folder);
    const std::string whole = test::readFile(files.second);
    const std::vector<std::string> broken{
        (folder / "missing.png").string(),
        folder.write("half.png", whole.substr(0, whole.size() / 2)),
        folder.write("text.png", "no picture"), folder.write("empty.png", "")};
    for (const auto& file : broken) {
        const auto result = match({files.first, file, "--out", (folder / "out").string()});
        EXPECT_EQ(result.exitCode, 1) << file;
        EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
        EXPECT_NE(result.output.find(file), std::string::npos) << result.output;
    }
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(SalmaFeaturesMatch, ReadsItsOptionsStrictly) {
    const CTemporaryFolder folder;
    const auto [a, b] = twoViews(folder);
    const std::string out = (folder / "out").string();
    const std::string wrong = folder.write("wrong.ini", "[picture_matcher]\nratoi = 0.7\n");
    const auto refused = match({a, b, "--out", out, "--config", wrong});
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_NE(refused.output.find("ratoi"), std::string::npos) << refused.output;
    const auto printed = match({"--print-config"});
    EXPECT_EQ(printed.exitCode, 0);
    EXPECT_NE(printed.output.find("[picture_matcher]"), std::string::npos);
}

TEST(SalmaFeaturesMatch, RefusesMisuseWithCodeTwo) {
    EXPECT_EQ(match({}).exitCode, 2);
    EXPECT_EQ(match({"a.png", "--out", "x"}).exitCode, 2);
    EXPECT_EQ(match({"a.png", "b.png"}).exitCode, 2);
    EXPECT_EQ(match({"a.png", "b.png", "--out", "x", "--colour"}).exitCode, 2);
}

/// The last word that is said of the mural's first picture and another one.
std::string decisionOnChurchill(const std::string& mural, const std::string& other) {
    const CTemporaryFolder folder;
    const auto result = match({mural, other, "--out", (folder / "out").string()});
    const std::string line = lastLine(result.output);
    return line.substr(line.rfind(' ') + 1);
}

TEST(SalmaFeaturesMatch, RecognisesTheChurchillMuralInAllItsPictures) {
    SALMA_NEED_DATA(data, "homography");
    for (int k = 2; k <= 6; ++k) {
        const std::string view = data + "/churchill/" + std::to_string(k) + ".png";
        EXPECT_EQ(decisionOnChurchill(data + "/churchill/1.png", view), "same") << view;
    }
}

TEST(SalmaFeaturesMatch, TakesNoOtherPictureForTheChurchillMural) {
    SALMA_NEED_DATA(mural, "homography/churchill/1.png");
    SALMA_NEED_DATA(planes, "homography");
    SALMA_NEED_DATA(corridor, "corridor_images");
    SALMA_NEED_DATA(posters, "posters");
    std::vector<std::string> others;
    for (const char k : std::string("14")) {
        others.push_back(planes + "/graf/img" + k + ".ppm");
        others.push_back(planes + "/boat/img" + k + ".pgm");
    }
    for (int k = 1; k <= 42; k += 12) others.push_back(corridor + "/" + std::to_string(k) + ".jpg");
    for (const char* name : {"kodak01", "kodak07", "brick"})
        others.push_back(posters + "/" + name + ".png");
    for (const auto& other : others) EXPECT_NE(decisionOnChurchill(mural, other), "same") << other;
}

}  // namespace
}  // namespace salma
