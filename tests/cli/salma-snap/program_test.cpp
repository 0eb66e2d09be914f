// SPDX-License-Identifier: BSD-3-Clause
// salma-snap as a process; below libv4l2 lies an emulated capture card (tests/emulators/video).
#include <gtest/gtest.h>
#include <messages.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <regex>
#include <thread>

#include "CProcess.h"
#include "CRunningProcess.h"
#include "CTemporaryFolder.h"

namespace fs = std::filesystem;

namespace salma {
namespace {

using salma::test::contains;

class SalmaSnap : public testing::Test {
 protected:
    std::vector<std::string> command(const std::string& card,
                                     const std::vector<std::string>& more) const {
        std::vector<std::string> words{"env",
                                       "ASAN_OPTIONS=verify_asan_link_order=0",
                                       "LD_PRELOAD=" SALMA_FAKE_VIDEO_LIBRARY,
                                       "SALMA_FAKE_VIDEO=" + card,
                                       test::program("salma-snap"),
                                       "/dev/fake-video",
                                       "--out",
                                       m_folder.path().string()};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    /// \param card Set-up of the capture card.
    test::TProcessResult snap(const std::string& card,
                              const std::vector<std::string>& more = {}) const {
        return test::runProcess(command(card, more));
    }

    std::vector<std::string> pictures() const {
        std::vector<std::string> files;
        for (const auto& entry : fs::directory_iterator(m_folder.path()))
            if (entry.path().filename() != "output") files.push_back(entry.path().string());
        std::sort(files.begin(), files.end());
        return files;
    }

    test::CTemporaryFolder m_folder;
};

void expectError(const test::TProcessResult& result, const std::string& part) {
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_TRUE(contains(result.output, "salma-snap: ")) << result.output;
    EXPECT_TRUE(contains(result.output, part)) << result.output;
}

/// A card shows bars, 40 pixels of 60 and 40 of 180.
void expectBars(const cv::Mat& picture, int tolerance) {
    for (const int y : {0, 1, picture.rows / 2, picture.rows - 1})
        for (int x = 20; x < picture.cols; x += 40) {
            const int expected = x % 80 < 40 ? 60 : 180;
            ASSERT_NEAR(picture.at<std::uint8_t>(y, x), expected, tolerance) << x << " " << y;
        }
}

/// YUV of the broadcast standards has 16 for black and 235 for white.
int fullRange(int luma) { return cv::saturate_cast<std::uint8_t>((luma - 16) * 255.0 / 219.0); }

}  // namespace

TEST_F(SalmaSnap, HelpStartsWithTwoExamples) {
    const auto help = test::runProcess({test::program("salma-snap"), "--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.output.find("Examples:\n  salma-snap /dev/video0 --list\n  salma-snap "), 0U)
        << help.output;
    EXPECT_EQ(test::runProcess({test::program("salma-snap"), "--version"}).exitCode, 0);
}

TEST_F(SalmaSnap, ListsWhatTheDeviceCanDo) {
    const auto list = snap("formats=UYVY:MJPG:BA81,interlaced=1", {"--list"});
    EXPECT_EQ(list.exitCode, 0) << list.output;
    for (const char* part :
         {"Fake capture card, driver fake", "0 Composite, standards PAL NTSC (chosen)",
          "1 S-Video, standards PAL NTSC, no signal", "UYVY", "MJPG", "BA81",
          "BGR3 BGR3, by libv4l2", "320 x 240, UYVY, interlaced"})
        EXPECT_TRUE(contains(list.output, part)) << part << "\n" << list.output;
    EXPECT_TRUE(pictures().empty());
}

TEST_F(SalmaSnap, SetsInputStandardAndSizeAndReadsThemBack) {
    const auto result =
        snap("", {"--input", "Composite", "--standard", "ntsc", "--size", "640x480"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(result.output.find("input 0, standard NTSC, picture 640 x 480, YUYV, progressive\n"),
              0U)
        << result.output;
    ASSERT_EQ(pictures().size(), 1U);
    const cv::Mat picture = cv::imread(pictures()[0], cv::IMREAD_GRAYSCALE);
    EXPECT_EQ(picture.size(), cv::Size(640, 480));
    EXPECT_TRUE(std::regex_search(pictures()[0],
                                  std::regex("/snap_20[0-9]{6}T[0-9]{6}\\.[0-9]{6}Z\\.png$")))
        << pictures()[0];
}

TEST_F(SalmaSnap, TellsWhereTheDeviceGivesAnotherThing) {
    const auto size = snap("size=640x480", {"--size", "768x576"});
    EXPECT_EQ(size.exitCode, 0);
    EXPECT_TRUE(contains(size.output, "notice: asked for 768 x 576, the device gives 640 x 480"))
        << size.output;
    EXPECT_EQ(cv::imread(pictures().at(0)).size(), cv::Size(640, 480));
    const auto format = snap("", {"--pixel-format", "GREY"});
    EXPECT_TRUE(contains(format.output, "notice: asked for GREY, the device gives YUYV"))
        << format.output;
    const auto input = snap("fault=restless", {"--input", "1", "--standard", "NTSC"});
    EXPECT_TRUE(contains(input.output, "asked for input 1, the device took 0")) << input.output;
    EXPECT_TRUE(contains(input.output, "input S-Video has no signal")) << input.output;
    EXPECT_TRUE(contains(input.output, "asked for standard NTSC, the device took PAL"))
        << input.output;
    expectError(snap("size=640x480", {"--size", "768x576", "--exact"}),
                "the device gives 640 x 480");
    EXPECT_EQ(pictures().size(), 3U);
}

TEST_F(SalmaSnap, UnderstandsEachPixelFormat) {
    const std::vector<std::pair<std::string, int>> cards = {{"YUYV", 2}, {"UYVY", 2}, {"MJPG", 6}};
    for (const auto& [format, tolerance] : cards) {
        ASSERT_EQ(snap("formats=" + format, {"--prefix", format}).exitCode, 0);
        const cv::Mat picture = cv::imread(pictures().at(0), cv::IMREAD_GRAYSCALE);
        ASSERT_FALSE(picture.empty());
        if (format == "MJPG") expectBars(picture, tolerance);
        for (int x = 20; format != "MJPG" && x < picture.cols; x += 40)
            ASSERT_NEAR(picture.at<std::uint8_t>(7, x), fullRange(x % 80 < 40 ? 60 : 180),
                        tolerance)
                << format << " " << x;
        fs::remove(pictures().at(0));
    }
    ASSERT_EQ(snap("formats=GREY").exitCode, 0);
    expectBars(cv::imread(pictures().at(0), cv::IMREAD_GRAYSCALE), 0);
    // What only libv4l2 understands, it converts.
    const auto bayer = snap("formats=BA81", {"--prefix", "zbayer"});
    EXPECT_EQ(bayer.exitCode, 0) << bayer.output;
    EXPECT_TRUE(contains(bayer.output, "RGB3")) << bayer.output;
    EXPECT_EQ(cv::imread(pictures().at(1)).size(), cv::Size(320, 240));
}

TEST_F(SalmaSnap, TakesInterlacedPicturesApart) {
    // The lower field shows the bars 40 pixels further: as it comes, light and dark lines
    // alternate.
    ASSERT_EQ(
        snap("formats=GREY,interlaced=1", {"--prefix", "a", "--deinterlace", "none"}).exitCode, 0);
    ASSERT_EQ(snap("formats=GREY,interlaced=1", {"--prefix", "b"}).exitCode, 0);
    ASSERT_EQ(
        snap("formats=GREY,interlaced=1", {"--prefix", "c", "--deinterlace", "blend"}).exitCode, 0);
    const auto files = pictures();
    ASSERT_EQ(files.size(), 3U);
    const cv::Mat comb = cv::imread(files[0], cv::IMREAD_GRAYSCALE);
    EXPECT_EQ(comb.at<std::uint8_t>(10, 20), 60);
    EXPECT_EQ(comb.at<std::uint8_t>(11, 20), 180);
    expectBars(cv::imread(files[1], cv::IMREAD_GRAYSCALE), 0);
    const cv::Mat blend = cv::imread(files[2], cv::IMREAD_GRAYSCALE);
    EXPECT_EQ(blend.at<std::uint8_t>(10, 20), 120);
    EXPECT_EQ(blend.at<std::uint8_t>(11, 60), 120);
}

TEST_F(SalmaSnap, TakesPicturesOverAndOver) {
    const auto result = snap("", {"--period", "0.05", "--count", "4", "--format", "jpg"});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_TRUE(contains(result.output, "pictures saved: 4, frames that could not be used: 0"))
        << result.output;
    EXPECT_EQ(pictures().size(), 4U);
    for (const auto& file : pictures()) EXPECT_FALSE(cv::imread(file).empty()) << file;
}

TEST_F(SalmaSnap, WritesPpmAsHoDid) {
    ASSERT_EQ(snap("formats=GREY", {"--format", "ppm"}).exitCode, 0);
    EXPECT_EQ(test::readFile(pictures().at(0)).substr(0, 2), "P6");
}

TEST_F(SalmaSnap, ASignalEndsTheContinuousMode) {
    test::CRunningProcess process(command("", {"--period", "0"}));
    while (process.running() && pictures().size() < 3)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    process.signal(SIGTERM);
    const auto result = process.wait();
    EXPECT_EQ(result.exitCode, 0) << result.output;
    for (const auto& file : pictures()) EXPECT_FALSE(cv::imread(file).empty()) << file;
}

TEST_F(SalmaSnap, FramesThatAreOfNoUseAreSkippedAndCounted) {
    for (const std::string fault : {"truncated", "damaged", "eio"}) {
        const auto result = snap("fault=" + fault + ",from=5,to=7", {"--count", "5"});
        EXPECT_EQ(result.exitCode, 0) << result.output;
        EXPECT_TRUE(contains(result.output, "pictures saved: 5, frames that could not be used: 3"))
            << result.output;
    }
    const auto jpeg = snap("formats=MJPG,fault=truncated,from=5,to=7", {"--count", "5"});
    EXPECT_TRUE(contains(jpeg.output, "notice: a frame is cut: a JPEG picture of")) << jpeg.output;
    EXPECT_TRUE(contains(jpeg.output, "saved: 5, frames that could not be used: 3")) << jpeg.output;
}

TEST_F(SalmaSnap, ADeviceThatGivesNothingUsableIsAnError) {
    expectError(snap("fault=truncated"),
                "25 frames in a row could not be used, the last one is cut: 51200 bytes instead of "
                "153600");
    expectError(snap("fault=eio"), "the last one is lost: Input/output error");
    expectError(snap("fault=silent,from=2", {"--timeout", "0.2"}), "gave no picture for 0.2 s");
    EXPECT_TRUE(pictures().empty());
}

TEST_F(SalmaSnap, ADeviceThatIsPulledOutEndsTheProgram) {
    const auto result = snap("fault=unplugged,from=7", {"--count", "9"});
    expectError(result, "the device is gone");
    EXPECT_EQ(pictures().size(), 3U);
    for (const auto& file : pictures()) EXPECT_FALSE(cv::imread(file).empty()) << file;
}

TEST_F(SalmaSnap, BlackPicturesAreToldAndKept) {
    const auto result = snap("formats=GREY,fault=black");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(contains(result.output, "png is black")) << result.output;
    EXPECT_EQ(pictures().size(), 1U);
}

TEST_F(SalmaSnap, DevicesAndPlacesThatAreNoneAreNamed) {
    const std::string program = test::program("salma-snap");
    expectError(test::runProcess({program, "/dev/no-such-video"}),
                "/dev/no-such-video: cannot be "
                "opened: No such file");
    expectError(test::runProcess({program, "/dev/null"}), "/dev/null: is not a video device");
    expectError(snap("", {"--input", "5"}), "has no input '5'; its inputs are 0 'Composite' 1");
    expectError(snap("", {"--standard", "FOO"}), "standard 'FOO' is not one of: PAL NTSC");
    expectError(snap("", {"--standard", "SECAM"}), "standard SECAM cannot be set");
    expectError(snap("standards=0", {"--standard", "PAL"}), "standard PAL cannot be set");
    expectError(snap("", {"--pixel-format", "TOOLONG"}), "pixel format 'TOOLONG'");
    auto nowhere = command("", {});
    nowhere.back() = "/no/such/folder";
    expectError(test::runProcess(nowhere), "/no/such/folder: no such folder");
}

TEST_F(SalmaSnap, MisuseIsExitCodeTwo) {
    EXPECT_EQ(test::runProcess({test::program("salma-snap")}).exitCode, 2);
    EXPECT_EQ(snap("", {"--size", "640"}).exitCode, 2);
    EXPECT_EQ(snap("", {"--size", "640x480x3"}).exitCode, 2);
    EXPECT_EQ(snap("", {"--format", "gif"}).exitCode, 2);
    EXPECT_EQ(snap("", {"--deinterlace", "often"}).exitCode, 2);
    EXPECT_EQ(snap("", {"--period", "-1"}).exitCode, 2);
}

}  // namespace salma
