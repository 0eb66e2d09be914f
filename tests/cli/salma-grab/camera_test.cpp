// SPDX-License-Identifier: BSD-3-Clause
// MRPT's CCameraSensor with the shipped ini file, in salma-grab and in stock rawlog-grabber: a
// folder of pictures and a video file in place of a camera.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/loadPicture.h>
#include <sys/stat.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "CProcess.h"
#include "CTemporaryFolder.h"
#include "emulatedRobot.h"

namespace fs = std::filesystem;

namespace salma {
namespace {

using test::contains;

constexpr int kPictures = 20;

class GrabbedCamera : public testing::Test {
 protected:
    void SetUp() override {
        cv::theRNG().state = 5;
        for (int i = 0; i < kPictures; ++i) {
            cv::Mat small(24, 32, CV_8UC3), picture;
            cv::randu(small, 40, 220);
            cv::resize(small, picture, cv::Size(320, 240));
            cv::imwrite(pictureFile(i), picture);
        }
    }

    std::string pictureFile(int i) const {
        return (m_folder / cv::format("img_%04d.jpg", i)).string();
    }

    /// The shipped file with one section in use. \param changes Text and what takes its place.
    std::string ini(const std::string& section,
                    const std::vector<std::pair<std::string, std::string>>& changes) const {
        std::string text = test::readFile(SALMA_SOURCE_DIR "/share/grabber/camera.ini");
        const auto replace = [&text](const std::string& from, const std::string& to) {
            const auto at = text.find(from);
            ASSERT_NE(at, std::string::npos) << from;
            text.replace(at, from.size(), to);
        };
        replace("[CAMERA]\n", "[CAMERA]\nrawlog-grabber-ignore = true\n");
        replace("[" + section + "]\nrawlog-grabber-ignore  = true\n", "[" + section + "]\n");
        replace("rawlog_prefix         = camera",
                "rawlog_prefix = " + (m_folder / "stock").string());
        for (const auto& [from, to] : changes) replace(from, to);
        return m_folder.write("camera.ini", text);
    }
    std::string folderIni() const {
        return ini("PICTURE_FOLDER", {{"/path/to/pictures", m_folder.path().string()},
                                      {"end_index              = 99", "end_index = 19"}});
    }
    std::string videoIni() const { return ini("VIDEO_FILE", {{"/path/to/video.avi", kVideo}}); }

    test::TProcessResult grab(const std::string& config, const std::string& seconds) const {
        return test::runProcess({test::program("salma-grab"), config, "--out",
                                 (m_folder / "x.rawlog").string(), "--duration", seconds});
    }
    /// Stock rawlog-grabber, ended by a key unless it ends by itself; the log's file.
    std::string stockGrab(const std::string& config, const std::string& seconds) const {
        const std::string keys = (m_folder / "keys").string();
        mkfifo(keys.c_str(), 0600);
        test::runProcess({"sh", "-c",
                          "(sleep " + seconds + "; echo q 1<>" + keys + ") & exec " +
                              "rawlog-grabber " + config + " 0<>" + keys});
        for (const auto& entry : fs::directory_iterator(m_folder.path()))
            if (entry.path().filename().string().rfind("stock_", 0) == 0 &&
                entry.path().extension() == ".rawlog")
                return entry.path().string();
        return "";
    }
    static bool hasStock() { return std::system("command -v rawlog-grabber >/dev/null") == 0; }

    /// Loads every picture of the log; how many.
    static std::size_t picturesOf(const std::string& file, const cv::Size& size) {
        const auto log = observations::readLog(file);
        for (const auto& step : log.steps) {
            const auto record =
                std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(step.observations.front());
            EXPECT_TRUE(record);
            if (!record) continue;
            EXPECT_EQ(record->sensorLabel, "CAMERA");
            EXPECT_NEAR(record->cameraPose.z(), 0.6, 1e-6);
            EXPECT_EQ(
                cv::imread(log.imagesFolder + "/" + record->image.getExternalStorageFile()).size(),
                size);
        }
        return log.steps.size();
    }

    static constexpr auto kVideo = "/usr/share/mrpt/datasets/dummy_video.avi";
    test::CTemporaryFolder m_folder;
};

}  // namespace

TEST_F(GrabbedCamera, EveryPictureOfAFolderIsRecorded) {
    const std::string config = folderIni();
    const auto result = grab(config, "20");
    EXPECT_EQ(result.exitCode, 1) << result.output;  // a camera that ends is a camera that failed
    EXPECT_TRUE(contains(result.output, "CAMERA failed: Reached end index.") ||
                contains(result.output, "PICTURE_FOLDER failed: Reached end index."))
        << result.output;
    EXPECT_EQ(picturesOf((m_folder / "x.rawlog").string(), {320, 240}),
              static_cast<std::size_t>(kPictures));
    if (!hasStock()) GTEST_SKIP() << "SKIPPED, rawlog-grabber of package mrpt-apps is not here";
    const std::string stock = stockGrab(config, "4");
    ASSERT_FALSE(stock.empty());
    const std::size_t recorded = picturesOf(stock, {320, 240});
    EXPECT_GT(recorded, 0U);
    EXPECT_LT(recorded, static_cast<std::size_t>(kPictures));  // why there is a salma-grab
}

TEST_F(GrabbedCamera, AVideoFileIsRecorded) {
    if (!fs::exists(kVideo)) GTEST_SKIP() << "SKIPPED, no " << kVideo << " of package mrpt-common";
    const std::string config = videoIni();
    const auto result = grab(config, "2");
    EXPECT_EQ(result.exitCode, 0) << result.output;
    const auto log = observations::readLog((m_folder / "x.rawlog").string());
    const auto first = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(
        log.steps.at(0).observations.front());
    const cv::Size size =
        cv::imread(log.imagesFolder + "/" + first->image.getExternalStorageFile()).size();
    EXPECT_GT(picturesOf((m_folder / "x.rawlog").string(), size), 1U);
    if (!hasStock()) GTEST_SKIP() << "SKIPPED, rawlog-grabber of package mrpt-apps is not here";
    const std::string stock = stockGrab(config, "3");
    ASSERT_FALSE(stock.empty());
    EXPECT_GT(picturesOf(stock, size), 0U);
}

TEST_F(GrabbedCamera, ACameraThatDeliversUselessPicturesIsTold) {
    for (int i = 5; i < kPictures; ++i) {  // the lower half does not come
        const std::string whole = test::readFile(pictureFile(i));
        m_folder.write(fs::path(pictureFile(i)).filename().string(),
                       whole.substr(0, whole.size() / 2));
    }
    const auto cut = grab(folderIni(), "20");
    EXPECT_TRUE(contains(cut.output, "CAMERA: a picture is cut: its lower part is missing"))
        << cut.output;
    for (int i = 5; i < kPictures; ++i)
        cv::imwrite(pictureFile(i), cv::Mat(200, 300, CV_8UC3, cv::Scalar(2, 3, 4)));
    fs::remove(m_folder / "x.rawlog");
    fs::remove_all(m_folder / "x_Images");
    const auto small = grab(folderIni(), "20");
    EXPECT_TRUE(
        contains(small.output, "a picture is 300 x 200 instead of the first one's 320 x 240"))
        << small.output;
    fs::remove(m_folder / "x.rawlog");
    fs::remove_all(m_folder / "x_Images");
    for (int i = 5; i < kPictures; ++i)
        cv::imwrite(pictureFile(i), cv::Mat(240, 320, CV_8UC3, cv::Scalar(2, 3, 4)));
    const auto black = grab(folderIni(), "20");
    EXPECT_TRUE(contains(black.output, "CAMERA: a picture is black (CAMERA_")) << black.output;
}

TEST_F(GrabbedCamera, ADeviceThatIsNotThereIsTold) {
    const auto result =
        test::runProcess({test::program("salma-grab"), SALMA_SOURCE_DIR "/share/grabber/camera.ini",
                          "--out", (m_folder / "x.rawlog").string()});
    if (fs::exists("/dev/video0")) GTEST_SKIP() << "SKIPPED, this computer has a camera";
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_TRUE(contains(result.output, "Couldn't open OpenCV camera")) << result.output;
    EXPECT_FALSE(fs::exists(m_folder / "x.rawlog"));
}

}  // namespace salma
