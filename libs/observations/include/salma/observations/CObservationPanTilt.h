// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/opengl/Visualizable.h>
#include <mrpt/poses/CPose3D.h>

namespace salma::observations {

/** State of a pan/tilt head that carries a camera.
 *
 * The head's frame h turns against its base b: T_b_h = Rz(pan) Ry(-tilt), so pan is positive to the
 * left and tilt positive upwards. The camera's pose is T_r_c = T_r_b T_b_h T_h_c. */
class CObservationPanTilt : public mrpt::obs::CObservation, public mrpt::opengl::Visualizable {
    DEFINE_SERIALIZABLE(CObservationPanTilt, salma::observations)

 public:
    double pan{0};                  //!< [rad]
    double tilt{0};                 //!< [rad]
    double zoom{1};                 //!< Focal length over the shortest one [-].
    mrpt::poses::CPose3D basePose;  //!< T_r_b: x forward, z up, at the crossing of the two axes.
    mrpt::poses::CPose3D cameraOnHead;  //!< T_h_c, optical frame of the camera.

    /// T_r_c for a given state of this head, e.g. one interpolated in time.
    mrpt::poses::CPose3D cameraPose(double pan_, double tilt_) const;
    mrpt::poses::CPose3D cameraPose() const { return cameraPose(pan, tilt); }

    /// The sensor is the head's base: these are `basePose`.
    void getSensorPose(mrpt::poses::CPose3D& pose) const override;
    void setSensorPose(const mrpt::poses::CPose3D& pose) override;

    void getDescriptionAsText(std::ostream& out) const override;
    bool exportTxtSupported() const override { return true; }
    std::string exportTxtHeader() const override;
    std::string exportTxtDataRow() const override;

    /// The camera's axes in the robot frame.
    void getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const override;
};

}  // namespace salma::observations
