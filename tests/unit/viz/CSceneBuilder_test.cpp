// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <mrpt/opengl/CFBORender.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CTexturedPlane.h>
#include <salma/viz/CSceneBuilder.h>

#include "exampleRun.h"

namespace salma::viz {
namespace {

TEST(CSceneBuilder, StandsAPatchUprightWithItsNormalTowardsTheRobot) {
    // A wall to the north, seen from the south: right is east, the normal points south.
    const auto T_w_p = patchPose(test::posterAt(3, 4, -M_PI / 2));
    const auto right = T_w_p.composePoint({1, 0, 0}) - T_w_p.translation();
    const auto up = T_w_p.composePoint({0, 1, 0}) - T_w_p.translation();
    const auto normal = T_w_p.composePoint({0, 0, 1}) - T_w_p.translation();
    EXPECT_NEAR((right - mrpt::math::TPoint3D(1, 0, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR((up - mrpt::math::TPoint3D(0, 0, 1)).norm(), 0, 1e-9);
    EXPECT_NEAR((normal - mrpt::math::TPoint3D(0, -1, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR((T_w_p.translation() - mrpt::math::TPoint3D(3, 4, 1.5)).norm(), 0, 1e-9);
}

TEST(CSceneBuilder, LeavesAFileThatReadsBackWithAllObjects) {
    const auto run = test::hallwayRun();
    const test::CTemporaryFolder folder;
    const std::string file = (folder / "scene.3Dscene").string();
    ASSERT_TRUE(CSceneBuilder(run.record).build()->saveToFile(file));
    mrpt::opengl::COpenGLScene scene;
    ASSERT_TRUE(scene.loadFromFile(file));
    for (const auto* name : {"grid", "laser", "path", "corner 0", "salient 18", "salient 23"})
        EXPECT_TRUE(scene.getByName(name)) << name;
    EXPECT_FALSE(scene.getByName("salient 24"));
    const auto path = std::dynamic_pointer_cast<mrpt::opengl::CSetOfLines>(scene.getByName("path"));
    ASSERT_TRUE(path);
    EXPECT_EQ(path->getLineCount(), run.record.trajectory.size() - 1);
}

TEST(CSceneBuilder, BuildsAnEmptyRunAndALandmarkWithoutPicture) {
    slam::TRunRecord record;
    EXPECT_TRUE(CSceneBuilder(record).build());
    record.landmarks = {test::posterAt(1, 1, std::nan("")), slam::TMapLandmark()};
    EXPECT_TRUE(CSceneBuilder(record).build()->getByName("salient 0"));
}

TEST(CSceneBuilder, ShowsThePatchTheRightWayUp) {
    // Only the patch, from 2 m before it: white but for its top left quarter.
    slam::TRunRecord record;
    record.landmarks = {test::posterAt(0, 2, -M_PI / 2)};
    const auto scene = CSceneBuilder(record).build();
    scene->getByName("grid")->setVisibility(false);
    auto& camera = scene->getViewport()->getCamera();
    camera.setPointingAt(0, 2, 1.5F);
    camera.setZoomDistance(2);
    camera.setAzimuthDegrees(-90);
    camera.setElevationDegrees(0);
    mrpt::img::CImage picture;
    try {
        mrpt::opengl::CFBORender render(400, 300);
        render.setCamera(*scene, camera);
        render.render_RGB(*scene, picture);
    } catch (const std::exception& e) {
        GTEST_SKIP() << "SKIPPED, nothing to render with here: " << e.what();
    }
    const auto grey = picture.grayscale();
    const int du = 40, dv = 28;  // well inside of the quarters
    EXPECT_LT(grey.at<std::uint8_t>(200 - du, 150 - dv), 60);
    EXPECT_GT(grey.at<std::uint8_t>(200 + du, 150 - dv), 200);
    EXPECT_GT(grey.at<std::uint8_t>(200 - du, 150 + dv), 200);
    EXPECT_GT(grey.at<std::uint8_t>(200 + du, 150 + dv), 200);
}

}  // namespace
}  // namespace salma::viz
