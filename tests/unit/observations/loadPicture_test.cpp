// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/observations/loadPicture.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "CTemporaryFolder.h"
#include "logs.h"

using namespace salma;
using test::CTemporaryFolder;

namespace {

cv::Mat colours() {
    cv::Mat picture(6, 8, CV_8UC3);
    for (int i = 0; i < 6 * 8 * 3; ++i) picture.data[i] = static_cast<std::uint8_t>(i);
    return picture;
}

std::string messageOf(const mrpt::obs::CObservationImage& observation, const std::string& folder) {
    try {
        observations::loadPicture(observation, folder);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

mrpt::obs::CObservationImage::Ptr embedded(const cv::Mat& picture) {
    auto observation = mrpt::obs::CObservationImage::Create();
    observation->sensorLabel = "CAMERA";
    observation->image = mrpt::img::CImage(picture, mrpt::img::DEEP_COPY);
    return observation;
}

}  // namespace

TEST(loadPicture, ExternalPicturesAreFoundInTheirFolder) {
    const CTemporaryFolder folder;
    cv::imwrite((folder / "a.png").string(), colours());
    const auto observation = test::pictureAt(0, "a.png");
    EXPECT_TRUE(observations::hasPicture(*observation, folder.path().string()));
    const cv::Mat picture = observations::loadPicture(*observation, folder.path().string());
    ASSERT_EQ(picture.type(), CV_8UC3);
    EXPECT_EQ(cv::norm(picture, colours(), cv::NORM_INF), 0);
    EXPECT_EQ(observations::pictureFileOf(*observation, "/f"), "/f/a.png");
    EXPECT_EQ(observations::pictureFileOf(*test::pictureAt(0, "/g/a.png"), "/f"), "/g/a.png");
}

TEST(loadPicture, GreyPicturesStayGrey) {
    const CTemporaryFolder folder;
    const cv::Mat grey(5, 9, CV_8UC1, cv::Scalar(77));
    cv::imwrite((folder / "g.png").string(), grey);
    const auto observation = test::pictureAt(0, "g.png");
    EXPECT_EQ(observations::loadPicture(*observation, folder.path().string()).type(), CV_8UC1);
}

TEST(loadPicture, GreyIsTheWeightedSumOfBlueGreenAndRed) {
    const cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(10, 100, 200));
    const cv::Mat grey = observations::loadGrey(*embedded(pixel), "");
    ASSERT_EQ(grey.type(), CV_8UC1);
    // 0.114 B + 0.587 G + 0.299 R = 119.6
    EXPECT_EQ(grey.at<std::uint8_t>(0, 0), 120);
}

TEST(loadPicture, AnEmbeddedPictureIsCopied) {
    const auto observation = embedded(colours());
    cv::Mat picture = observations::loadPicture(*observation, "/nowhere");
    picture.setTo(0);
    EXPECT_EQ(cv::norm(observations::loadPicture(*observation, ""), colours(), cv::NORM_INF), 0);
    EXPECT_EQ(observations::pictureFileOf(*observation, "/f"), "");
    EXPECT_TRUE(observations::hasPicture(*observation, ""));
}

TEST(loadPicture, ErrorsNameTheFile) {
    const CTemporaryFolder folder;
    const std::string place = folder.path().string();
    folder.write("empty.jpg", "");
    folder.write("text.jpg", "no picture at all");
    cv::imwrite((folder / "deep.png").string(), cv::Mat(3, 3, CV_16UC1, cv::Scalar(9)));
    EXPECT_EQ(messageOf(*test::pictureAt(0, "gone.jpg"), place),
              place + "/gone.jpg: no such picture");
    EXPECT_EQ(messageOf(*test::pictureAt(0, "empty.jpg"), place), place + "/empty.jpg: is empty");
    EXPECT_EQ(messageOf(*test::pictureAt(0, "text.jpg"), place),
              place + "/text.jpg: is not a picture");
    EXPECT_EQ(messageOf(*test::pictureAt(0, "deep.png"), place),
              place + "/deep.png: is not a grey or colour picture of 8 bits");
    EXPECT_FALSE(observations::hasPicture(*test::pictureAt(0, "gone.jpg"), place));
    mrpt::obs::CObservationImage none;
    none.sensorLabel = "CAM7";
    EXPECT_NE(messageOf(none, place).find("'CAM7'"), std::string::npos);
    EXPECT_FALSE(observations::hasPicture(none, place));
}

TEST(loadPicture, ThreadsWithDifferentFoldersDoNotDisturbEachOther) {
    const CTemporaryFolder folder;
    const auto observation = test::pictureAt(0, "same.png");
    std::vector<std::thread> threads;
    std::array<bool, 4> right{};
    for (int i = 0; i < 4; ++i) {
        const auto place = folder / std::to_string(i);
        std::filesystem::create_directory(place);
        cv::imwrite((place / "same.png").string(), cv::Mat(30, 30, CV_8UC1, cv::Scalar(50 * i)));
    }
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&, i] {
            right[i] = true;
            for (int k = 0; k < 50; ++k) {
                const cv::Mat picture =
                    observations::loadPicture(*observation, (folder / std::to_string(i)).string());
                right[i] = right[i] && picture.at<std::uint8_t>(3, 3) == 50 * i;
            }
        });
    for (auto& thread : threads) thread.join();
    for (const bool ok : right) EXPECT_TRUE(ok);
}
