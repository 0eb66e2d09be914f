// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/opengl/Visualizable.h>
#include <mrpt/poses/CPose3D.h>
#include <salma/observations/TPatch.h>
#include <salma/observations/TPlaceString.h>

#include <string>
#include <vector>

namespace salma::observations {

/** What the front end saw in one picture: the salient entities on the walls, rectified and
 * described.
 *
 * It holds no pose of the robot in the world, so a record can be replayed through any back end. A
 * picture without any landmark still leaves a record. The timestamp is the picture's. */
class CObservationSalientLandmarks : public mrpt::obs::CObservation,
                                     public mrpt::opengl::Visualizable {
    DEFINE_SERIALIZABLE(CObservationSalientLandmarks, salma::observations)

 public:
    mrpt::poses::CPose3D cameraPose;  //!< T_r_c, optical frame (z forward, x right, y down).
    mrpt::img::TCamera camera;        //!< Intrinsics and distortion of the picture.
    std::string pictureFile;          //!< File name of the source picture; "" if it had none.
    TPlaceString placeString;         //!< Of the scan nearest in time.
    std::vector<TPatch> landmarks;

    /// The sensor is the camera: these are `cameraPose`.
    void getSensorPose(mrpt::poses::CPose3D& pose) const override;
    void setSensorPose(const mrpt::poses::CPose3D& pose) override;

    void getDescriptionAsText(std::ostream& out) const override;
    bool exportTxtSupported() const override { return true; }
    std::string exportTxtHeader() const override;
    std::string exportTxtDataRow() const override;

    /// Each patch as a textured plane at its pose in the robot frame.
    void getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const override;
};

}  // namespace salma::observations
