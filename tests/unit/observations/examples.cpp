// SPDX-License-Identifier: BSD-3-Clause
#include "examples.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <salma/observations/registerClasses.h>
#include <zlib.h>

#include <opencv2/core.hpp>
#include <stdexcept>

using mrpt::poses::CPose3D;
using namespace salma::observations;

namespace salma::test {
namespace {

constexpr double kTime = 1'000'000'000.25;  // [s], exact in ticks of 100 ns
constexpr double kTight = 1e-12;            // of angles that went through a rotation matrix

void expectPose(const CPose3D& pose, const std::array<double, 6>& wanted) {
    EXPECT_EQ(pose.x(), wanted[0]);
    EXPECT_EQ(pose.y(), wanted[1]);
    EXPECT_EQ(pose.z(), wanted[2]);
    EXPECT_NEAR(pose.yaw(), wanted[3], kTight);
    EXPECT_NEAR(pose.pitch(), wanted[4], kTight);
    EXPECT_NEAR(pose.roll(), wanted[5], kTight);
}

cv::Mat examplePicture() {
    cv::Mat pixels(5, 7, CV_8UC1);
    for (int i = 0; i < 35; ++i) pixels.data[i] = static_cast<std::uint8_t>(7 * i);
    return pixels;
}

TKeypoint exampleKeypoint() {
    TKeypoint keypoint;
    keypoint.x = 0.11;
    keypoint.y = -0.12;
    keypoint.scale = 0.013;
    keypoint.angle = 1.4;
    for (int i = 0; i < 128; ++i) keypoint.descriptor[i] = static_cast<std::uint8_t>(2 * i + 1);
    return keypoint;
}

TPatch examplePatch() {
    TPatch patch;
    patch.quad = {{{10.5, 20.25}, {110, 21}, {111, 81}, {11, 82}}};
    patch.pose.mean = CPose3D(2.5, -1.25, 1.5, -0.3, 0.02, 1.57);
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) patch.pose.cov(i, j) = 0.001 * (1 + i + j) + (i == j ? 1 : 0);
    patch.width = 0.9;
    patch.height = 0.6;
    patch.pixelsPerMetre = 160;
    patch.picture = mrpt::img::CImage(examplePicture(), mrpt::img::DEEP_COPY);
    patch.regions = {{30, 40, 8, 4.5, 0.25, 1.125}, {31, 41, 9, 4.25, 0.5, 2.125}};
    patch.keypoints = {exampleKeypoint()};
    patch.texture = {0.25F, 0.75F, 0};
    patch.incidence = 0.35;
    return patch;
}

void expectFrontMatter(const CObservationSalientLandmarks& record) {
    EXPECT_EQ(record.sensorLabel, "SALIENT");
    EXPECT_EQ(mrpt::Clock::toDouble(record.timestamp), kTime);
    expectPose(record.cameraPose, {0.1, 0.2, 1.1, -1.5, 0.03, -1.6});
    EXPECT_EQ(record.camera.ncols, 768U);
    EXPECT_EQ(record.camera.nrows, 492U);
    EXPECT_EQ(record.camera.fx(), 700);
    EXPECT_EQ(record.camera.fy(), 701);
    EXPECT_EQ(record.camera.cx(), 384.5);
    EXPECT_EQ(record.camera.cy(), 246.5);
    EXPECT_EQ(record.camera.distortion, mrpt::img::DistortionModel::plumb_bob);
    EXPECT_EQ(record.camera.dist,
              (std::array<double, 8>{-0.2, 0.05, 0.001, -0.002, 0.003, 0, 0, 0}));
    EXPECT_EQ(record.camera.cameraName, "evi");
    EXPECT_EQ(record.pictureFile, "CAMERA_1.jpg");
    ASSERT_EQ(record.placeString.size(), 3U);
    const TPlaceString wanted{{'W', 3.5, 0.02}, {'C', 0, 0.01}, {'J', -1, 0.5}};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(record.placeString[i].letter, wanted[i].letter);
        EXPECT_EQ(record.placeString[i].value, wanted[i].value);
        EXPECT_EQ(record.placeString[i].sigma, wanted[i].sigma);
    }
}

void expectLists(const TPatch& patch) {
    ASSERT_EQ(patch.regions.size(), 2U);
    const TSalientRegion& region = patch.regions[1];
    EXPECT_EQ((std::array<double, 6>{region.x, region.y, region.s, region.H, region.W, region.Y}),
              (std::array<double, 6>{31, 41, 9, 4.25, 0.5, 2.125}));
    EXPECT_EQ(patch.regions[0].x, 30);
    EXPECT_EQ(patch.regions[0].Y, 1.125);
    ASSERT_EQ(patch.keypoints.size(), 1U);
    const TKeypoint& keypoint = patch.keypoints[0];
    EXPECT_EQ((std::array<double, 4>{keypoint.x, keypoint.y, keypoint.scale, keypoint.angle}),
              (std::array<double, 4>{0.11, -0.12, 0.013, 1.4}));
    for (int i = 0; i < 128; ++i) EXPECT_EQ(keypoint.descriptor[i], (2 * i + 1) % 256);
    EXPECT_EQ(patch.texture, (std::vector<float>{0.25F, 0.75F, 0}));
}

void expectPatch(const TPatch& patch) {
    EXPECT_EQ(patch.quad[0], mrpt::math::TPoint2D(10.5, 20.25));
    EXPECT_EQ(patch.quad[1], mrpt::math::TPoint2D(110, 21));
    EXPECT_EQ(patch.quad[2], mrpt::math::TPoint2D(111, 81));
    EXPECT_EQ(patch.quad[3], mrpt::math::TPoint2D(11, 82));
    expectPose(patch.pose.mean, {2.5, -1.25, 1.5, -0.3, 0.02, 1.57});
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            EXPECT_EQ(patch.pose.cov(i, j), 0.001 * (1 + i + j) + (i == j ? 1 : 0));
    EXPECT_EQ(patch.width, 0.9);
    EXPECT_EQ(patch.height, 0.6);
    EXPECT_EQ(patch.pixelsPerMetre, 160);
    EXPECT_EQ(patch.incidence, 0.35);
    const cv::Mat picture = patch.picture.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    ASSERT_EQ(picture.type(), CV_8UC1);
    ASSERT_EQ(picture.size(), cv::Size(7, 5));
    EXPECT_EQ(cv::norm(picture, examplePicture(), cv::NORM_INF), 0);
}

}  // namespace

CObservationSalientLandmarks::Ptr exampleRecord() {
    auto record = CObservationSalientLandmarks::Create();
    record->sensorLabel = "SALIENT";
    record->timestamp = mrpt::Clock::fromDouble(kTime);
    record->cameraPose = CPose3D(0.1, 0.2, 1.1, -1.5, 0.03, -1.6);
    record->camera.ncols = 768;
    record->camera.nrows = 492;
    record->camera.setIntrinsicParamsFromValues(700, 701, 384.5, 246.5);
    record->camera.setDistortionPlumbBob(-0.2, 0.05, 0.001, -0.002, 0.003);
    record->camera.cameraName = "evi";
    record->pictureFile = "CAMERA_1.jpg";
    record->placeString = {{'W', 3.5, 0.02}, {'C', 0, 0.01}, {'J', -1, 0.5}};
    record->landmarks = {examplePatch(), TPatch()};
    record->landmarks[1].pose.mean = CPose3D(4, 0, 1, 3, 0, 1.5);
    record->landmarks[1].width = 0.5;
    record->landmarks[1].height = 0.25;
    return record;
}

void expectExample(const CObservationSalientLandmarks& record) {
    expectFrontMatter(record);
    ASSERT_EQ(record.landmarks.size(), 2U);
    expectPatch(record.landmarks[0]);
    expectLists(record.landmarks[0]);
    expectPose(record.landmarks[1].pose.mean, {4, 0, 1, 3, 0, 1.5});
    EXPECT_EQ(record.landmarks[1].width, 0.5);
    EXPECT_EQ(record.landmarks[1].height, 0.25);
    EXPECT_TRUE(record.landmarks[1].regions.empty());
    EXPECT_TRUE(record.landmarks[1].picture.isEmpty());
    EXPECT_TRUE(record.landmarks[1].keypoints.empty());
    EXPECT_TRUE(record.landmarks[1].texture.empty());
}

CObservationPanTilt::Ptr examplePanTilt() {
    auto state = CObservationPanTilt::Create();
    state->sensorLabel = "HEAD";
    state->timestamp = mrpt::Clock::fromDouble(kTime);
    state->pan = 0.4;
    state->tilt = -0.1;
    state->zoom = 1.5;
    state->basePose = CPose3D(0.15, 0.01, 1.2, 0.05, 0.06, 0.07);
    state->cameraOnHead = CPose3D(0.03, 0.02, 0.04, -1.57, 0.08, -1.55);
    return state;
}

void expectExample(const CObservationPanTilt& state) {
    EXPECT_EQ(state.sensorLabel, "HEAD");
    EXPECT_EQ(mrpt::Clock::toDouble(state.timestamp), kTime);
    EXPECT_EQ(state.pan, 0.4);
    EXPECT_EQ(state.tilt, -0.1);
    EXPECT_EQ(state.zoom, 1.5);
    expectPose(state.basePose, {0.15, 0.01, 1.2, 0.05, 0.06, 0.07});
    expectPose(state.cameraOnHead, {0.03, 0.02, 0.04, -1.57, 0.08, -1.55});
}

std::string bytesOf(const TObjects& objects) {
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    for (const auto& object : objects) archive << *object;
    return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

std::string packed(const std::string& bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("zlib does not start");
    std::string result(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(result.data());
    stream.avail_out = static_cast<uInt>(result.size());
    deflate(&stream, Z_FINISH);
    result.resize(stream.total_out);
    deflateEnd(&stream);
    return result;
}

mrpt::serialization::CSerializable::Ptr objectOf(const std::string& bytes) {
    registerClasses();
    mrpt::io::CMemoryStream stream;
    stream.Write(bytes.data(), bytes.size());
    stream.Seek(0);
    return mrpt::serialization::archiveFrom(stream).ReadObject();
}

}  // namespace salma::test
