// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/observations/CPanTiltHistory.h>

using salma::observations::CObservationPanTilt;
using salma::observations::CPanTiltHistory;

namespace {

CObservationPanTilt::Ptr stateAt(double time, double pan, double tilt) {
    auto state = CObservationPanTilt::Create();
    state->timestamp = mrpt::Clock::fromDouble(time);
    state->pan = pan;
    state->tilt = tilt;
    state->basePose = mrpt::poses::CPose3D(0.2, 0, 1, 0, 0, 0);
    return state;
}

}  // namespace

TEST(CPanTiltHistory, InterpolatesPanAndTilt) {
    CPanTiltHistory history;
    history.add(stateAt(100, 0, 0.2));
    history.add(stateAt(101, 0.4, 0));
    const auto pose = history.cameraPose(100.25, 0);
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->yaw(), 0.1, 1e-6);
    EXPECT_NEAR(pose->pitch(), -0.15, 1e-6);
    EXPECT_DOUBLE_EQ(pose->x(), 0.2);
    EXPECT_DOUBLE_EQ(pose->z(), 1);
}

TEST(CPanTiltHistory, AHeadDoesNotTurnPastItsBack) {
    // From +3 to -3 rad the head goes all the way round through 0, not over pi.
    CPanTiltHistory history;
    history.add(stateAt(100, 3, 0));
    history.add(stateAt(101, -3, 0));
    EXPECT_NEAR(history.cameraPose(100.5, 0)->yaw(), 0, 1e-6);
}

TEST(CPanTiltHistory, HoldsTheEndsWithinTheSkewAndNoFurther) {
    CPanTiltHistory history;
    EXPECT_FALSE(history.cameraPose(0, 1e12));
    history.add(stateAt(100, 0.3, 0));
    EXPECT_NEAR(history.cameraPose(100.5, 0.5)->yaw(), 0.3, 1e-12);
    EXPECT_FALSE(history.cameraPose(101, 0.5));
    EXPECT_FALSE(history.cameraPose(99, 0.5));
}

TEST(CPanTiltHistory, RefusesDecreasingStampsAndNothing) {
    CPanTiltHistory history;
    EXPECT_THROW(history.add(nullptr), std::invalid_argument);
    history.add(stateAt(100, 0, 0));
    history.add(stateAt(100, 0.5, 0));
    EXPECT_NEAR(history.cameraPose(100, 0)->yaw(), 0.5, 1e-12);
    EXPECT_THROW(history.add(stateAt(99, 0, 0)), std::invalid_argument);
}

TEST(CPanTiltHistory, ForgetsWhatIsOldButKeepsTheTimeItself) {
    CPanTiltHistory history;
    history.forgetBefore(100);
    for (int i = 0; i <= 10; ++i) history.add(stateAt(100 + i, 0.1 * i, 0));
    history.forgetBefore(99);
    EXPECT_NEAR(history.cameraPose(100, 0)->yaw(), 0, 1e-9);
    history.forgetBefore(104.5);
    EXPECT_FALSE(history.cameraPose(103.9, 0));
    EXPECT_NEAR(history.cameraPose(104.5, 0)->yaw(), 0.45, 1e-6);
    EXPECT_NEAR(history.cameraPose(110, 0)->yaw(), 1, 1e-9);
    history.forgetBefore(200);
    EXPECT_NEAR(history.cameraPose(110, 0)->yaw(), 1, 1e-9);
    EXPECT_FALSE(history.cameraPose(109, 0));
}
