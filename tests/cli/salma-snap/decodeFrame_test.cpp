// SPDX-License-Identifier: BSD-3-Clause
#include "decodeFrame.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <random>

#include "videoNames.h"

namespace salma::apps {
namespace {

CVideoDevice::TFormat format(int width, int height, std::uint32_t fourcc, std::uint32_t line) {
    CVideoDevice::TFormat f;
    f.width = width;
    f.height = height;
    f.fourcc = fourcc;
    f.bytesPerLine = line;
    return f;
}

std::string messageOf(const CVideoDevice::TFormat& f, const std::vector<std::uint8_t>& bytes) {
    try {
        decodeFrame(f, bytes);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST(DecodeFrame, KeepsToTheLengthOfALineInMemory) {
    // Two rows of two pixels, each followed by two bytes of padding.
    const cv::Mat picture =
        decodeFrame(format(2, 2, V4L2_PIX_FMT_GREY, 4), {1, 2, 9, 9, 3, 4, 9, 9});
    EXPECT_EQ(picture.at<std::uint8_t>(0, 1), 2);
    EXPECT_EQ(picture.at<std::uint8_t>(1, 0), 3);
    EXPECT_EQ(picture.at<std::uint8_t>(1, 1), 4);
}

TEST(DecodeFrame, PutsColoursInTheirPlaces) {
    const cv::Mat bgr = decodeFrame(format(1, 1, V4L2_PIX_FMT_RGB24, 3), {10, 20, 30});
    EXPECT_EQ(bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(30, 20, 10));
    // Y = 126 without colour is 128 in full range: (126 - 16) * 255 / 219.
    const cv::Mat yuyv = decodeFrame(format(2, 1, V4L2_PIX_FMT_YUYV, 4), {126, 128, 16, 128});
    EXPECT_EQ(yuyv.at<cv::Vec3b>(0, 0), cv::Vec3b(128, 128, 128));
    EXPECT_EQ(yuyv.at<cv::Vec3b>(0, 1), cv::Vec3b(0, 0, 0));
}

TEST(DecodeFrame, SaysWhatIsWrong) {
    EXPECT_EQ(messageOf(format(2, 2, V4L2_PIX_FMT_YUYV, 4), {1, 2, 3, 4, 5, 6, 7}),
              "cut: 7 bytes instead of 8");
    EXPECT_EQ(messageOf(format(2, 2, V4L2_PIX_FMT_NV12, 2), {1, 2, 3, 4, 5}),
              "cut: 5 bytes instead of 6");
    EXPECT_EQ(messageOf(format(2, 2, V4L2_PIX_FMT_SBGGR8, 2), {1, 2, 3, 4}),
              "of a pixel format that is not known");
    std::vector<std::uint8_t> jpeg;
    cv::imencode(".jpg", cv::Mat(16, 16, CV_8UC3, cv::Scalar(1, 2, 3)), jpeg);
    EXPECT_EQ(messageOf(format(16, 16, V4L2_PIX_FMT_MJPEG, 0), jpeg), "");
    EXPECT_EQ(messageOf(format(32, 16, V4L2_PIX_FMT_MJPEG, 0), jpeg), "of another size: 16 x 16");
    jpeg.resize(jpeg.size() + 5, 0);  // padding is no fault
    EXPECT_EQ(messageOf(format(16, 16, V4L2_PIX_FMT_MJPEG, 0), jpeg), "");
    EXPECT_EQ(messageOf(format(16, 16, V4L2_PIX_FMT_MJPEG, 0), {}),
              "cut: a JPEG picture of 0 bytes without its end");
}

TEST(DecodeFrame, TakesAnyBytesWithoutHarm) {
    std::mt19937 random(11);
    const std::vector<std::uint32_t> formats = {
        V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_UYVY,   V4L2_PIX_FMT_BGR24, V4L2_PIX_FMT_GREY,
        V4L2_PIX_FMT_NV12, V4L2_PIX_FMT_YUV420, V4L2_PIX_FMT_MJPEG};
    std::vector<std::uint8_t> jpeg;
    cv::imencode(".jpg", cv::Mat(24, 32, CV_8UC3, cv::Scalar(90, 20, 200)), jpeg);
    int decoded = 0, refused = 0;
    for (int i = 0; i < 500; ++i) {
        const auto fourcc = formats[random() % formats.size()];
        std::vector<std::uint8_t> bytes(random() % 4000);
        for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
        if (fourcc == V4L2_PIX_FMT_MJPEG) {
            bytes = jpeg;
            for (int n = 0; n < 3; ++n)
                bytes[2 + random() % (bytes.size() - 4)] = static_cast<std::uint8_t>(random());
        }
        try {
            const cv::Mat picture = decodeFrame(format(32, 24, fourcc, 0), bytes);
            EXPECT_EQ(picture.size(), cv::Size(32, 24));
            ++decoded;
        } catch (const std::exception&) {
            ++refused;
        }
    }
    EXPECT_GT(decoded, 50);
    EXPECT_GT(refused, 50);
}

TEST(VideoNames, GoBothWays) {
    EXPECT_EQ(nameOfPixelFormat(V4L2_PIX_FMT_YUYV), "YUYV");
    EXPECT_EQ(pixelFormatOf("YUYV"), static_cast<std::uint32_t>(V4L2_PIX_FMT_YUYV));
    EXPECT_EQ(pixelFormatOf("Y16"), static_cast<std::uint32_t>(V4L2_PIX_FMT_Y16));
    EXPECT_EQ(nameOfPixelFormat(V4L2_PIX_FMT_Y16), "Y16");
    EXPECT_EQ(standardOf("pal"), static_cast<std::uint64_t>(V4L2_STD_PAL));
    EXPECT_EQ(nameOfStandard(V4L2_STD_PAL | V4L2_STD_NTSC), "PAL NTSC");
    EXPECT_EQ(nameOfStandard(V4L2_STD_PAL_BG), "PAL-BG");
    EXPECT_EQ(nameOfStandard(0), "none");
    EXPECT_THROW(standardOf("PALE"), std::invalid_argument);
    EXPECT_THROW(pixelFormatOf(""), std::invalid_argument);
}

}  // namespace salma::apps
