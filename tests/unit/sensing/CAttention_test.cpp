// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>
#include <salma/sensing/CAttention.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace salma::sensing {
namespace {

using mrpt::DEG2RAD;
using mrpt::math::TPoint3D;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using observations::CObservationPanTilt;
using observations::CObservationSalientLandmarks;

CObservationPanTilt headOf(const CPose3D& base = {0.2, 0, 1, 0, 0, 0}) {
    CObservationPanTilt head;
    head.basePose = base;
    head.cameraOnHead = CPose3D(0.05, 0.01, 0.03, -M_PI_2, 0, -M_PI_2);
    return head;
}

/// A poster on the wall y = 2, `x` metres along it, seen from a robot at `T_o_r`.
CObservationSalientLandmarks posterSeen(double x, const CPose2D& T_o_r) {
    observations::TPatch patch;
    patch.width = patch.height = 0.5;
    // v upwards, u to the right as one faces the wall (that is along +x), normal along -y
    const CPose3D T_o_p(x, 2, 1.5, 0, 0, M_PI_2);
    patch.pose.mean = T_o_p - CPose3D(T_o_r);
    CObservationSalientLandmarks record;
    record.landmarks.push_back(patch);
    return record;
}

const TGazeLimits kLimits{DEG2RAD(-100.0), DEG2RAD(100.0), DEG2RAD(-25.0), DEG2RAD(25.0)};

TAttentionOptions attend() {
    TAttentionOptions options;
    options.use = true;
    return options;
}

}  // namespace

TEST(gazeAt, BringsThePointToTheMiddleOfThePicture) {
    for (const CPose3D& base :
         {CPose3D(0.2, 0, 1, 0, 0, 0), CPose3D(0, 0.1, 0.5, DEG2RAD(30.0), DEG2RAD(5.0), 0),
          CPose3D(0, 0, 1, 0, 0, M_PI) /* upside down */}) {
        const auto head = headOf(base);
        for (const TPoint3D& point : {TPoint3D(3, 0, 1), TPoint3D(2, 1, 1.5), TPoint3D(1, -2, 0.5),
                                      TPoint3D(-0.5, 2, 1.2)}) {
            const TGaze gaze = gazeAt(head, point);
            const auto seen = head.cameraPose(gaze.pan, gaze.tilt).inverseComposePoint(point);
            EXPECT_NEAR(seen.x, 0, 1e-9);
            EXPECT_NEAR(seen.y, 0, 1e-9);
            EXPECT_GT(seen.z, 0);
        }
    }
}

TEST(CAttention, FollowsWhatItSawUntilItIsConfirmedAndThenLooksAheadAgain) {
    const auto head = headOf();
    CAttention attention(attend(), kLimits, {});
    EXPECT_FALSE(attention.gaze({}, head, 0)) << "looks ahead already";
    double pan = 0, x = 0;
    for (; x < 3 && attention.confirmed() == 0; x += 0.1) {
        const CPose2D T_o_r(x, 0, 0);
        attention.see(posterSeen(2, T_o_r), T_o_r, x);
        const auto gaze = attention.gaze(T_o_r, head, x);
        if (gaze) pan = gaze->pan;
        if (attention.confirmed() > 0) break;
        ASSERT_TRUE(attention.isAttending());
        EXPECT_NEAR(pan, std::atan2(2, 2 - x - 0.2), DEG2RAD(2.5)) << x;
    }
    EXPECT_GT(x, 0.05) << "one view confirms nothing";
    EXPECT_LT(x, 1) << "5 deg between the views are soon there";
    EXPECT_FALSE(attention.isAttending());
    EXPECT_NEAR(pan, 0, 1e-12);
    // It is not looked at a second time.
    attention.see(posterSeen(2, {x, 0, 0}), {x, 0, 0}, x);
    EXPECT_FALSE(attention.isAttending());
    EXPECT_FALSE(attention.gaze({x, 0, 0}, head, x));
    // Another one is.
    attention.see(posterSeen(4, {x, 0, 0}), {x, 0, 0}, x);
    EXPECT_TRUE(attention.isAttending());
}

TEST(CAttention, LetsGoWhatIsNotConfirmedInTimeOrOutOfReach) {
    const auto head = headOf();
    CAttention attention(attend(), kLimits, {});
    attention.see(posterSeen(2, {}), {}, 100);
    EXPECT_TRUE(attention.gaze({}, head, 100));
    attention.see(posterSeen(2, {}), {}, 119.9);  // standing still confirms nothing
    EXPECT_TRUE(attention.isAttending());
    EXPECT_NEAR(attention.gaze({}, head, 120)->pan, 0, 1e-12);
    EXPECT_FALSE(attention.isAttending());
    EXPECT_EQ(attention.letGo(), 1u);
    // The robot turns away from the second one.
    attention.see(posterSeen(4, {}), {}, 200);
    ASSERT_TRUE(attention.gaze({}, head, 200));
    EXPECT_NEAR(attention.gaze({0, 0, DEG2RAD(-100.0)}, head, 201)->pan, 0, 1e-12);
    EXPECT_EQ(attention.letGo(), 2u);
    EXPECT_EQ(attention.confirmed(), 0u);
}

TEST(CAttention, MakesNoSmallCorrections) {
    const auto head = headOf();
    CAttention attention(attend(), kLimits, {});
    attention.see(posterSeen(2, {}), {}, 0);
    ASSERT_TRUE(attention.gaze({}, head, 0));
    EXPECT_FALSE(attention.gaze({0, 0, DEG2RAD(0.9)}, head, 0));
    EXPECT_TRUE(attention.gaze({0, 0, DEG2RAD(1.1)}, head, 0));
}

TEST(CAttention, RefusesARestThatTheHeadCannotReach) {
    auto options = attend();
    options.restPan = DEG2RAD(120.0);
    EXPECT_THROW(CAttention(options, kLimits, {}), std::invalid_argument);
    options.restPan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(CAttention(options, kLimits, {}), std::invalid_argument);
}

}  // namespace salma::sensing
