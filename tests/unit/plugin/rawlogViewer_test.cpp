// SPDX-License-Identifier: BSD-3-Clause
// MRPT's RawLogViewer, as it is installed, on a screen of its own: are text and patches seen?
// With SALMA_SCREENSHOT=FILE.png the test leaves what it saw there.
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "CProcess.h"
#include "CTemporaryFolder.h"
#include "examples.h"
#include "logs.h"
#include "stockProgram.h"

using namespace salma;

namespace {

namespace fs = std::filesystem;

/// BGR of what Xvfb shows; its file is an X window dump with big-endian numbers.
cv::Mat screenOf(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    const auto number = [&](std::size_t i) {
        std::uint32_t value = 0;
        for (std::size_t k = 0; k < 4; ++k)
            value = value << 8U | static_cast<std::uint8_t>(bytes.at(4 * i + k));
        return static_cast<int>(value);
    };
    const int width = number(4), height = number(5), bits = number(11), stride = number(12);
    const int start = number(0) + 12 * number(19);  // 12 bytes for each entry of the colour table
    if (bits != 32 || bytes.size() < static_cast<std::size_t>(start + stride * height)) return {};
    cv::Mat screen(height, width, CV_8UC3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                screen.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>(
                    bytes[static_cast<std::size_t>(start + stride * y + 4 * x + c)]);
    return screen;
}

class RawLogViewer : public testing::Test {
 protected:
    void SetUp() override {
        for (const std::string name : {"RawLogViewer", "Xvfb", "xdotool", "openbox"})
            if (std::system(("command -v " + name + " >/dev/null").c_str()) != 0)
                GTEST_SKIP() << "SKIPPED, not installed: " << name;
    }
    void TearDown() override {
        m_folder.write("STOP", "");
        if (m_session.valid()) m_session.wait();
    }

    void show(const std::string& rawlog) {
        auto command = test::stockProgram("sh");
        command.insert(command.end(), {SALMA_SOURCE_DIR "/tests/unit/plugin/rawlogViewer.sh",
                                       m_folder.path().string(), SALMA_PLUGIN, rawlog});
        m_session = std::async(std::launch::async, [command] { return test::runProcess(command); });
        ASSERT_TRUE(within([&] { return fs::exists(m_folder / "display"); })) << "no X server";
        m_display = test::readFile(m_folder / "display");
        m_display = m_display.substr(0, m_display.find('\n'));
    }

    /// What xdotool says; "" if it fails.
    std::string xdo(const std::string& command) const {
        const auto result = test::runProcess(
            {"sh", "-c", "DISPLAY=:" + m_display + " timeout 10 xdotool " + command});
        return result.exitCode == 0 ? result.output : "";
    }
    /// Tried again and again: xdotool stumbles over windows that come and go.
    std::string window(const std::string& name) const {
        std::string found;
        within([&] {
            found = xdo("search --onlyvisible --name '" + name + "' 2>/dev/null");
            return !found.empty();
        });
        return found.substr(0, found.find('\n'));
    }

    static bool within(const std::function<bool()>& done) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (!done()) {
            if (std::chrono::steady_clock::now() > end) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        return true;
    }

    cv::Mat screen() const { return screenOf((m_folder / "Xvfb_screen0").string()); }

    /// Pixels of the 3D view (the right half below) that are as red as the frame of a patch.
    int redPixels() const {
        const cv::Mat all = screen();
        if (all.empty()) return -1;
        cv::Mat red;
        cv::inRange(all(cv::Rect(420, 570, 960, 260)), cv::Scalar(0, 0, 150),
                    cv::Scalar(80, 80, 255), red);
        return cv::countNonZero(red);
    }
    /// Dark pixels of the text (the right half above).
    int inkPixels() const {
        const cv::Mat all = screen();
        if (all.empty()) return -1;
        cv::Mat ink;
        cv::inRange(all(cv::Rect(420, 125, 960, 380)), cv::Scalar(0, 0, 0), cv::Scalar(90, 90, 90),
                    ink);
        return cv::countNonZero(ink);
    }

    test::CTemporaryFolder m_folder;
    std::future<test::TProcessResult> m_session;
    std::string m_display;
};

/// A record with one poster of 1.8 x 1.2 m, square to the view of RawLogViewer's camera.
observations::CObservationSalientLandmarks::Ptr poster() {
    auto record = test::exampleRecord();
    record->landmarks.resize(1);
    record->landmarks[0].width = 1.8;
    record->landmarks[0].height = 1.2;
    return record;
}

}  // namespace

TEST_F(RawLogViewer, ShowsTheTextAndThePatchesOfARecord) {
    const std::string rawlog = m_folder.write(
        "log.rawlog", test::packed(test::bytesOf({test::scanAt(0), poster(), test::scanAt(1)})));
    ASSERT_NO_FATAL_FAILURE(show(rawlog));
    ASSERT_FALSE(window("RawlogViewer").empty());
    const std::string tip = window("Tip of the Day");
    ASSERT_FALSE(tip.empty());
    // By a key, as people do it: a window that is destroyed from outside ends the program.
    ASSERT_TRUE(within([&] {
        xdo("windowactivate --sync " + tip + " key Escape 2>/dev/null");
        return xdo("search --onlyvisible --name 'Tip of the Day' 2>/dev/null").empty();
    }));
    const int inkBefore = inkPixels();
    EXPECT_LE(redPixels(), 0) << "nothing is selected yet";
    // Rows are as high as the fonts are: down the list until the record is hit.
    int y = 150;
    const bool seen = within([&] {
        xdo("mousemove 150 " + std::to_string(y) + " click 1 mousemove 900 700 click --repeat 4 4");
        y = y >= 190 ? 150 : y + 5;
        return redPixels() >= 100;
    });
    const auto log = test::readFile(m_folder / "viewer.log");
    if (const char* file = std::getenv("SALMA_SCREENSHOT")) cv::imwrite(file, screen());
    EXPECT_TRUE(seen) << redPixels() << " red pixels; " << log;
    EXPECT_GT(inkPixels(), inkBefore + 1000) << "its text";
    EXPECT_FALSE(fs::exists(m_folder / "viewer.ended")) << log;
    EXPECT_EQ(log.find("not registered"), std::string::npos) << log;
}
