// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CSimpleLine.h>
#include <mrpt/serialization/CArchive.h>
#include <salma/observations/CObservationPanTilt.h>

#include <ostream>

#include "drawing.h"
#include "recordIo.h"

IMPLEMENTS_SERIALIZABLE(CObservationPanTilt, mrpt::obs::CObservation, salma::observations)

using mrpt::poses::CPose3D;

namespace salma::observations {

std::uint8_t CObservationPanTilt::serializeGetVersion() const { return 0; }

void CObservationPanTilt::serializeTo(mrpt::serialization::CArchive& out) const {
    io::writeText(out, sensorLabel);
    out << timestamp << pan << tilt << zoom;
    io::writePose(out, basePose);
    io::writePose(out, cameraOnHead);
}

void CObservationPanTilt::serializeFrom(mrpt::serialization::CArchive& in, std::uint8_t version) {
    if (version > 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
    sensorLabel = io::readText(in, "letters of a sensor label");
    in >> timestamp;
    pan = io::readFinite(in, "pan");
    tilt = io::readFinite(in, "tilt");
    zoom = io::readFinite(in, "zoom");
    basePose = io::readPose(in);
    cameraOnHead = io::readPose(in);
}

CPose3D CObservationPanTilt::cameraPose(double pan_, double tilt_) const {
    const CPose3D headOnBase(0, 0, 0, pan_, -tilt_, 0);
    return basePose + headOnBase + cameraOnHead;
}

void CObservationPanTilt::getSensorPose(CPose3D& pose) const { pose = basePose; }

void CObservationPanTilt::setSensorPose(const CPose3D& pose) { basePose = pose; }

void CObservationPanTilt::getDescriptionAsText(std::ostream& out) const {
    CObservation::getDescriptionAsText(out);
    out << mrpt::format("Pan: %.3f deg (left is positive)\n", mrpt::RAD2DEG(pan))
        << mrpt::format("Tilt: %.3f deg (up is positive)\n", mrpt::RAD2DEG(tilt))
        << mrpt::format("Zoom: %.3f\n", zoom) << "Base in the robot frame: " << basePose << "\n"
        << "Camera on the head: " << cameraOnHead << "\n"
        << "Camera in the robot frame: " << cameraPose() << "\n";
}

std::string CObservationPanTilt::exportTxtHeader() const {
    return "pan_deg tilt_deg zoom camera_x_m camera_y_m camera_z_m camera_yaw_deg camera_pitch_deg "
           "camera_roll_deg";
}

std::string CObservationPanTilt::exportTxtDataRow() const {
    const CPose3D camera = cameraPose();
    return mrpt::format("%.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f", mrpt::RAD2DEG(pan),
                        mrpt::RAD2DEG(tilt), zoom, camera.x(), camera.y(), camera.z(),
                        mrpt::RAD2DEG(camera.yaw()), mrpt::RAD2DEG(camera.pitch()),
                        mrpt::RAD2DEG(camera.roll()));
}

void CObservationPanTilt::getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const {
    const CPose3D camera = cameraPose();
    drawing::insertAxes(objects, basePose, 0.1F, "pan/tilt base");
    drawing::insertAxes(objects, camera, 0.2F, sensorLabel);
    auto arm = mrpt::opengl::CSimpleLine::Create();
    arm->setLineCoords(basePose.x(), basePose.y(), basePose.z(), camera.x(), camera.y(),
                       camera.z());
    objects.insert(arm);
}

}  // namespace salma::observations
