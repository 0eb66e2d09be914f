// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CTexturedPlane.h>
#include <mrpt/serialization/CArchive.h>
#include <salma/observations/CObservationSalientLandmarks.h>

#include <opencv2/core.hpp>
#include <ostream>

#include "drawing.h"
#include "patchIo.h"
#include "recordIo.h"

IMPLEMENTS_SERIALIZABLE(CObservationSalientLandmarks, mrpt::obs::CObservation, salma::observations)

using mrpt::poses::CPose3D;

namespace salma::observations {
namespace {

std::string letters(const TPlaceString& place) {
    std::string text;
    for (const TPlaceLetter& letter : place) text += letter.letter;
    return text.empty() ? "-" : text;
}

void describe(std::ostream& out, std::size_t index, const TPatch& patch) {
    const CPose3D& pose = patch.pose.mean;
    out << mrpt::format("Landmark %zu: %.3f x %.3f m at x=%.3f y=%.3f z=%.3f m, yaw %.2f deg, ",
                        index, patch.width, patch.height, pose.x(), pose.y(), pose.z(),
                        mrpt::RAD2DEG(pose.yaw()))
        << mrpt::format("sigma x %.4f y %.4f m, incidence %.1f deg\n",
                        std::sqrt(patch.pose.cov(0, 0)), std::sqrt(patch.pose.cov(1, 1)),
                        mrpt::RAD2DEG(patch.incidence))
        << mrpt::format("  patch %d x %d px at %.1f px/m, %zu regions, %zu keypoints, %zu bins\n",
                        patch.picture.isEmpty() ? 0 : static_cast<int>(patch.picture.getWidth()),
                        patch.picture.isEmpty() ? 0 : static_cast<int>(patch.picture.getHeight()),
                        patch.pixelsPerMetre, patch.regions.size(), patch.keypoints.size(),
                        patch.texture.size());
}

mrpt::opengl::CSetOfLines::Ptr frameOf(const TPatch& patch) {
    const double u = patch.width / 2;
    const double v = patch.height / 2;
    auto lines = mrpt::opengl::CSetOfLines::Create();
    lines->appendLine(-u, -v, 0, u, -v, 0);
    lines->appendLineStrip(u, v, 0);
    lines->appendLineStrip(-u, v, 0);
    lines->appendLineStrip(-u, -v, 0);
    lines->setPose(patch.pose.mean);
    lines->setColor_u8(mrpt::img::TColor::red());
    return lines;
}

/// From the camera to the corners of the patch.
mrpt::opengl::CSetOfLines::Ptr raysTo(const TPatch& patch, const CPose3D& camera) {
    auto rays = mrpt::opengl::CSetOfLines::Create();
    for (const double u : {-patch.width / 2, patch.width / 2})
        for (const double v : {-patch.height / 2, patch.height / 2}) {
            const auto corner = patch.pose.mean.composePoint({u, v, 0});
            rays->appendLine(camera.x(), camera.y(), camera.z(), corner.x, corner.y, corner.z);
        }
    rays->setColor_u8(mrpt::img::TColor(255, 200, 0));
    return rays;
}

mrpt::opengl::CTexturedPlane::Ptr planeOf(const TPatch& patch) {
    const auto u = static_cast<float>(patch.width / 2);
    const auto v = static_cast<float>(patch.height / 2);
    auto plane = mrpt::opengl::CTexturedPlane::Create(-u, u, -v, v);
    plane->setPose(patch.pose.mean);
    if (patch.picture.isEmpty()) return plane;
    // MRPT puts the first row of a texture at the smallest y, which is the lower edge here.
    cv::Mat upsideDown;
    cv::flip(patch.picture.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY), upsideDown, 0);
    plane->assignImage(mrpt::img::CImage(upsideDown, mrpt::img::DEEP_COPY));
    return plane;
}

}  // namespace

std::uint8_t CObservationSalientLandmarks::serializeGetVersion() const { return 1; }

void CObservationSalientLandmarks::serializeTo(mrpt::serialization::CArchive& out) const {
    io::writeText(out, sensorLabel);
    out << timestamp;
    io::writePose(out, cameraPose);
    out << camera;
    io::writeText(out, pictureFile);
    io::writePlace(out, placeString);
    io::writeCount(out, landmarks.size(), io::kMaxLandmarks);
    for (const TPatch& patch : landmarks) io::writePatch(out, patch);
}

void CObservationSalientLandmarks::serializeFrom(mrpt::serialization::CArchive& in,
                                                 std::uint8_t version) {
    if (version > 1) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
    sensorLabel = io::readText(in, "letters of a sensor label");
    in >> timestamp;
    cameraPose = io::readPose(in);
    in >> camera;
    pictureFile = io::readText(in, "letters of a file name");
    placeString = io::readPlace(in);
    landmarks.clear();
    const std::size_t count = io::readCount(in, io::kMaxLandmarks, "landmarks");
    for (std::size_t i = 0; i < count; ++i) landmarks.push_back(io::readPatch(in, version));
}

void CObservationSalientLandmarks::getSensorPose(CPose3D& pose) const { pose = cameraPose; }

void CObservationSalientLandmarks::setSensorPose(const CPose3D& pose) { cameraPose = pose; }

void CObservationSalientLandmarks::getDescriptionAsText(std::ostream& out) const {
    CObservation::getDescriptionAsText(out);
    out << "Camera in the robot frame: " << cameraPose << "\n"
        << "Source picture: " << (pictureFile.empty() ? "-" : pictureFile) << "\n"
        << "Place string: " << letters(placeString) << "\n"
        << "Salient landmarks: " << landmarks.size() << "\n";
    for (std::size_t i = 0; i < landmarks.size(); ++i) describe(out, i, landmarks[i]);
    out << "Camera:\n" << camera.dumpAsText() << "\n";
}

std::string CObservationSalientLandmarks::exportTxtHeader() const {
    return "landmarks regions keypoints camera_x_m camera_y_m camera_z_m camera_yaw_deg "
           "camera_pitch_deg camera_roll_deg place_string picture_file";
}

std::string CObservationSalientLandmarks::exportTxtDataRow() const {
    std::size_t regions = 0;
    std::size_t keypoints = 0;
    for (const TPatch& patch : landmarks) {
        regions += patch.regions.size();
        keypoints += patch.keypoints.size();
    }
    return mrpt::format("%zu %zu %zu %.6f %.6f %.6f %.6f %.6f %.6f ", landmarks.size(), regions,
                        keypoints, cameraPose.x(), cameraPose.y(), cameraPose.z(),
                        mrpt::RAD2DEG(cameraPose.yaw()), mrpt::RAD2DEG(cameraPose.pitch()),
                        mrpt::RAD2DEG(cameraPose.roll())) +
           letters(placeString) + " " + (pictureFile.empty() ? "-" : pictureFile);
}

void CObservationSalientLandmarks::getVisualizationInto(
    mrpt::opengl::CSetOfObjects& objects) const {
    drawing::insertAxes(objects, CPose3D(), 0.5F, "robot");
    drawing::insertAxes(objects, cameraPose, 0.2F, sensorLabel);
    for (const TPatch& patch : landmarks) {
        if (!(patch.width > 0 && patch.height > 0)) continue;  // MRPT refuses such a plane
        objects.insert(planeOf(patch));
        objects.insert(frameOf(patch));
        objects.insert(raysTo(patch, cameraPose));
        drawing::insertAxes(objects, patch.pose.mean, 0.2F, "");
    }
}

}  // namespace salma::observations
