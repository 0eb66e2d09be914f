// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/opengl/COpenGLScene.h>
#include <salma/slam/TRunRecord.h>

namespace salma::viz {

/** The result of a run in 3D: grid, scan points, path, landmarks with 2 sigma ellipsoids, and the
 * patches of the salient ones standing at their place on the wall.
 *
 * The laser's map is flat; patches stand at the height at which the robot saw them. */
class CSceneBuilder {
 public:
    /// `record` must outlive this object.
    explicit CSceneBuilder(const slam::TRunRecord& record);

    /// Frame: world. The camera looks at the middle of the map.
    mrpt::opengl::COpenGLScene::Ptr build() const;

 private:
    mrpt::opengl::CRenderizable::Ptr grid() const;
    mrpt::opengl::CRenderizable::Ptr scanPoints() const;
    mrpt::opengl::CRenderizable::Ptr path() const;
    mrpt::opengl::CRenderizable::Ptr landmark(const slam::TMapLandmark& landmark) const;

    const slam::TRunRecord& m_record;
};

/** T_w_p of the patch of a map landmark: z of the patch frame points along the wall's normal.
 * \return The identity rotation about z where the landmark has no patch or no wall angle. */
mrpt::poses::CPose3D patchPose(const slam::TMapLandmark& landmark);

}  // namespace salma::viz
