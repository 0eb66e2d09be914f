// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/registerClasses.h>

#include <cstring>

#include "CTemporaryFolder.h"
#include "examples.h"

using namespace salma;
using mrpt::poses::CPose3D;
using observations::CObservationPanTilt;

namespace {

/// T_h_c of a camera that looks along the head's x axis: z forward, x right, y down.
CPose3D lookingAhead() { return CPose3D(0, 0, 0, -M_PI / 2, 0, -M_PI / 2); }

mrpt::math::TPoint3D inRobotFrame(const CPose3D& camera, double x, double y, double z) {
    return camera.composePoint(mrpt::math::TPoint3D(x, y, z));
}

}  // namespace

TEST(CObservationPanTilt, EveryFieldSurvivesARoundTrip) {
    const auto object = test::objectOf(test::bytesOf({test::examplePanTilt()}));
    const auto state = std::dynamic_pointer_cast<CObservationPanTilt>(object);
    ASSERT_TRUE(state);
    test::expectExample(*state);
}

TEST(CObservationPanTilt, Version0StaysReadable) {
    const std::string bytes =
        test::readFile(std::string(SALMA_SOURCE_DIR) + "/tests/data/legacy/pan-tilt-v0.rawlog");
    const auto state = std::dynamic_pointer_cast<CObservationPanTilt>(test::objectOf(bytes));
    ASSERT_TRUE(state);
    test::expectExample(*state);
}

TEST(CObservationPanTilt, AnUnknownVersionIsRefused) {
    std::string bytes = test::bytesOf({test::examplePanTilt()});
    bytes.at(1 + std::strlen("salma::observations::CObservationPanTilt")) = 1;
    EXPECT_THROW(test::objectOf(bytes), std::exception);
}

TEST(CObservationPanTilt, PositivePanTurnsTheCameraToTheLeft) {
    CObservationPanTilt state;
    state.basePose = CPose3D(1, 0, 2, 0, 0, 0);
    state.cameraOnHead = lookingAhead();
    state.pan = M_PI / 2;
    // A point 3 m ahead of the camera lies to the left of the robot.
    const auto point = inRobotFrame(state.cameraPose(), 0, 0, 3);
    EXPECT_NEAR(point.x, 1, 1e-12);
    EXPECT_NEAR(point.y, 3, 1e-12);
    EXPECT_NEAR(point.z, 2, 1e-12);
}

TEST(CObservationPanTilt, PositiveTiltTurnsTheCameraUp) {
    CObservationPanTilt state;
    state.cameraOnHead = lookingAhead();
    state.tilt = M_PI / 6;
    const auto point = inRobotFrame(state.cameraPose(), 0, 0, 2);
    EXPECT_NEAR(point.x, std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(point.y, 0, 1e-12);
    EXPECT_NEAR(point.z, 1, 1e-12);
    // Down in the picture stays down: y of the camera has no part to the side.
    EXPECT_NEAR(inRobotFrame(state.cameraPose(), 0, 1, 0).y, 0, 1e-12);
}

TEST(CObservationPanTilt, TextAndExportNameTheAnglesInDegrees) {
    CObservationPanTilt state;
    state.pan = M_PI / 4;
    state.tilt = -M_PI / 18;
    const std::string text = state.asString();
    EXPECT_NE(text.find("Pan: 45.000 deg"), std::string::npos) << text;
    EXPECT_NE(text.find("Tilt: -10.000 deg"), std::string::npos);
    EXPECT_EQ(state.exportTxtHeader().find("pan_deg tilt_deg zoom "), 0U);
    EXPECT_EQ(state.exportTxtDataRow().find("45.000000 -10.000000 1.000000 "), 0U);
}

TEST(CObservationPanTilt, DrawsAxesAtTheCamera) {
    mrpt::opengl::CSetOfObjects scene;
    const auto state = test::examplePanTilt();
    state->getVisualizationInto(scene);
    bool found = false;
    for (const auto& object : scene)
        found = found || CPose3D(object->getPose()).distanceTo(state->cameraPose()) < 1e-9;
    EXPECT_TRUE(found);
}
