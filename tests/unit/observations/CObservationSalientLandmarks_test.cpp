// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CTexturedPlane.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/registerClasses.h>

#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <sstream>

#include "CTemporaryFolder.h"
#include "examples.h"

using namespace salma;
using observations::CObservationSalientLandmarks;

namespace {

CObservationSalientLandmarks::Ptr roundTrip(const CObservationSalientLandmarks::Ptr& record) {
    const auto object = test::objectOf(test::bytesOf({record}));
    return std::dynamic_pointer_cast<CObservationSalientLandmarks>(object);
}

std::size_t words(const std::string& line) {
    std::istringstream in(line);
    std::size_t n = 0;
    for (std::string word; in >> word;) ++n;
    return n;
}

/// Bytes of the example with the little-endian number `find` replaced where it stands `nth`.
std::string withNumber(std::uint32_t find, std::uint32_t replacement, const std::string& behind) {
    std::string bytes = test::bytesOf({test::exampleRecord()});
    std::string pattern(4, '\0');
    std::memcpy(pattern.data(), &find, 4);
    const std::size_t at = bytes.find(pattern + behind);
    if (at == std::string::npos) throw std::logic_error("the example has changed");
    std::memcpy(&bytes[at], &replacement, 4);
    return bytes;
}

}  // namespace

TEST(CObservationSalientLandmarks, EveryFieldSurvivesARoundTrip) {
    const auto read = roundTrip(test::exampleRecord());
    ASSERT_TRUE(read);
    test::expectExample(*read);
}

TEST(CObservationSalientLandmarks, ARecordWithoutLandmarksSurvivesToo) {
    auto record = CObservationSalientLandmarks::Create();
    record->sensorLabel = "EMPTY";
    const auto read = roundTrip(record);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->sensorLabel, "EMPTY");
    EXPECT_TRUE(read->landmarks.empty());
}

TEST(CObservationSalientLandmarks, Version0StaysReadable) {
    const auto log = observations::readLog(std::string(SALMA_SOURCE_DIR) +
                                           "/tests/data/legacy/salient-landmarks-v0.rawlog");
    ASSERT_EQ(log.steps.size(), 1U);
    const auto record =
        std::dynamic_pointer_cast<CObservationSalientLandmarks>(log.steps[0].observations.at(0));
    ASSERT_TRUE(record);
    // Its regions were pixels: (30, 40) of a quad about 100 px x 61 px large, which shows
    // 0.9 m x 0.6 m, lies 0.275 m left of the centre and 0.107 m above it.
    auto& regions = record->landmarks[0].regions;
    ASSERT_EQ(regions.size(), 2U);
    EXPECT_NEAR(regions[0].x, -0.275, 0.005);
    EXPECT_NEAR(regions[0].y, 0.107, 0.005);
    EXPECT_NEAR(regions[0].s, 8 * std::sqrt(0.9 / 99.5 * 0.6 / 61), 0.001);
    EXPECT_EQ(regions[1].Y, 2.125);
    regions = test::exampleRecord()->landmarks[0].regions;
    test::expectExample(*record);
}

TEST(CObservationSalientLandmarks, RegionsOfVersion0WithoutAQuadAreDropped) {
    auto example = test::exampleRecord();
    example->landmarks[0].quad.fill({5, 5});
    std::string bytes = test::bytesOf({example});
    bytes[1 + std::strlen("salma::observations::CObservationSalientLandmarks")] = 0;
    const auto record =
        std::dynamic_pointer_cast<CObservationSalientLandmarks>(test::objectOf(bytes));
    ASSERT_TRUE(record);
    EXPECT_TRUE(record->landmarks[0].regions.empty());
}

TEST(CObservationSalientLandmarks, IsRegisteredUnderItsQualifiedName) {
    observations::registerClasses();
    observations::registerClasses();
    EXPECT_NE(mrpt::rtti::findRegisteredClass("salma::observations::CObservationSalientLandmarks"),
              nullptr);
}

TEST(CObservationSalientLandmarks, APictureThatIsAViewOfAnotherIsWrittenRightly) {
    cv::Mat large(20, 30, CV_8UC1);
    for (int i = 0; i < 600; ++i) large.data[i] = static_cast<std::uint8_t>(i % 251);
    const cv::Mat view = large(cv::Rect(5, 4, 9, 6));
    ASSERT_FALSE(view.isContinuous());
    auto record = test::exampleRecord();
    record->landmarks[0].picture = mrpt::img::CImage(view, mrpt::img::SHALLOW_COPY);
    const auto read = roundTrip(record);
    ASSERT_TRUE(read);
    const cv::Mat picture = read->landmarks[0].picture.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    ASSERT_EQ(picture.size(), view.size());
    EXPECT_EQ(cv::norm(picture, view, cv::NORM_INF), 0);
}

TEST(CObservationSalientLandmarks, AColourPictureIsRefused) {
    auto record = test::exampleRecord();
    record->landmarks[0].picture =
        mrpt::img::CImage(cv::Mat(4, 4, CV_8UC3, cv::Scalar(1, 2, 3)), mrpt::img::DEEP_COPY);
    EXPECT_THROW(test::bytesOf({record}), std::exception);
}

TEST(CObservationSalientLandmarks, AnUnknownVersionIsRefused) {
    std::string bytes = test::bytesOf({test::exampleRecord()});
    const std::size_t version =
        1 + std::strlen("salma::observations::CObservationSalientLandmarks");
    ASSERT_EQ(bytes.at(version), 1);
    bytes[version] = 2;
    EXPECT_THROW(test::objectOf(bytes), std::exception);
}

TEST(CObservationSalientLandmarks, FalseCountsAreRefusedWithoutClaimingTheirMemory) {
    const std::uint32_t huge = 0xFFFFFFFF;
    EXPECT_THROW(test::objectOf(withNumber(7, huge, "SALIENT")), std::exception);
    EXPECT_THROW(test::objectOf(withNumber(12, huge, "CAMERA_1.jpg")), std::exception);
    EXPECT_THROW(test::objectOf(withNumber(3, huge, "W")), std::exception);
    const std::string five("\5\0\0\0", 4);
    EXPECT_THROW(test::objectOf(withNumber(7, huge, five)), std::exception);
    // A size within the limits, but more than the record holds.
    EXPECT_THROW(test::objectOf(withNumber(7, 8192, five)), std::exception);
}

TEST(CObservationSalientLandmarks, ANumberThatIsNoneIsRefused) {
    auto record = test::exampleRecord();
    record->landmarks[0].width = std::nan("");
    EXPECT_THROW(roundTrip(record), std::exception);
}

TEST(CObservationSalientLandmarks, ARecordCutAnywhereIsRefused) {
    const std::string bytes = test::bytesOf({test::exampleRecord()});
    for (std::size_t length = 0; length < bytes.size(); length += 13)
        EXPECT_THROW(test::objectOf(bytes.substr(0, length)), std::exception) << length;
}

TEST(CObservationSalientLandmarks, TheTextNamesWhatWasSeen) {
    const std::string text = test::exampleRecord()->asString();
    EXPECT_NE(text.find("Sensor label: 'SALIENT'"), std::string::npos) << text;
    EXPECT_NE(text.find("Salient landmarks: 2"), std::string::npos);
    EXPECT_NE(text.find("Place string: WCJ"), std::string::npos);
    EXPECT_NE(text.find("Source picture: CAMERA_1.jpg"), std::string::npos);
    EXPECT_NE(text.find("Landmark 0: 0.900 x 0.600 m at x=2.500 y=-1.250 z=1.500 m"),
              std::string::npos);
    EXPECT_NE(text.find("patch 7 x 5 px at 160.0 px/m, 2 regions, 1 keypoints, 3 bins"),
              std::string::npos);
}

TEST(CObservationSalientLandmarks, ExportsOneWordPerColumn) {
    const auto record = test::exampleRecord();
    ASSERT_TRUE(record->exportTxtSupported());
    EXPECT_EQ(words(record->exportTxtHeader()), words(record->exportTxtDataRow()));
    EXPECT_EQ(record->exportTxtDataRow().substr(0, 6), "2 2 1 ");
    const auto bare = CObservationSalientLandmarks::Create();
    EXPECT_EQ(words(bare->exportTxtHeader()), words(bare->exportTxtDataRow()));
}

TEST(CObservationSalientLandmarks, DrawsEachPatchAsATexturedPlaneAtItsPose) {
    const auto record = test::exampleRecord();
    mrpt::opengl::CSetOfObjects scene;
    record->getVisualizationInto(scene);
    std::vector<mrpt::opengl::CTexturedPlane::Ptr> planes;
    for (const auto& object : scene)
        if (auto plane = std::dynamic_pointer_cast<mrpt::opengl::CTexturedPlane>(object))
            planes.push_back(plane);
    ASSERT_EQ(planes.size(), 2U);
    float xMin = 0, xMax = 0, yMin = 0, yMax = 0;
    planes[0]->getPlaneCorners(xMin, xMax, yMin, yMax);
    EXPECT_FLOAT_EQ(xMin, -0.45F);
    EXPECT_FLOAT_EQ(xMax, 0.45F);
    EXPECT_FLOAT_EQ(yMin, -0.3F);
    EXPECT_FLOAT_EQ(yMax, 0.3F);
    EXPECT_LT(record->landmarks[0].pose.mean.distanceTo(mrpt::poses::CPose3D(planes[0]->getPose())),
              1e-9);
    // MRPT draws the first row of a texture at the bottom: the top row must come last.
    const auto texture = planes[0]->getTextureImage().asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    const auto picture = record->landmarks[0].picture.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    ASSERT_EQ(texture.size(), cv::Size(7, 5));
    EXPECT_EQ(texture.at<std::uint8_t>(4, 1), picture.at<std::uint8_t>(0, 1));
    EXPECT_EQ(texture.at<std::uint8_t>(0, 1), picture.at<std::uint8_t>(4, 1));
}
