// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <salma/sensing/CJoinQueue.h>

#include <cmath>

namespace salma::sensing {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationImage;
using mrpt::obs::CObservationOdometry;
using observations::CObservationPanTilt;

template <class T>
typename T::Ptr at(double time) {
    auto o = T::Create();
    o->timestamp = mrpt::Clock::fromDouble(time);
    return o;
}

CObservationPanTilt::Ptr head(double time, double pan) {
    auto state = at<CObservationPanTilt>(time);
    state->pan = pan;
    return state;
}

CObservationOdometry::Ptr odometry(double time, double x) {
    auto o = at<CObservationOdometry>(time);
    o->odometry = {x, 0, 0};
    return o;
}

double timeOf(const mrpt::obs::CObservation& o) { return mrpt::Clock::toDouble(o.timestamp); }

TEST(CJoinQueue, JoinsAPictureWithTheNearestScanAndThePosesOfItsTime) {
    CJoinQueue queue({true, true, 0.25, 0, 5});
    queue.add(at<CObservation2DRangeScan>(100.0));
    queue.add(odometry(100.0, 1.0));
    queue.add(head(100.0, 0.2));
    queue.add(at<CObservationImage>(100.06), 7);
    EXPECT_TRUE(queue.take(7).empty()) << "a nearer scan may come";
    queue.add(at<CObservation2DRangeScan>(100.1));
    queue.add(odometry(100.1, 2.0));
    EXPECT_TRUE(queue.take(7.1).empty()) << "the head may move on";
    queue.add(head(100.1, 0.4));
    const auto taken = queue.take(7.2);
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken[0].fate, EFate::joined);
    EXPECT_NEAR(timeOf(*taken[0].job.scan), 100.1, 1e-6);
    EXPECT_NEAR(taken[0].job.T_picture_scan.x(), 0.4, 1e-5);
    ASSERT_TRUE(taken[0].T_o_r);
    EXPECT_NEAR(taken[0].T_o_r->x(), 1.6, 1e-5);
    EXPECT_NEAR(taken[0].job.T_r_c.yaw(), 0.32, 1e-5);
    EXPECT_TRUE(queue.take(100).empty()) << "once";
    EXPECT_NEAR(queue.robot()->x(), 2, 1e-12);
}

TEST(CJoinQueue, WaitsForTheOdometryOfALaterScan) {
    CJoinQueue queue({false, true, 0.25, 0, 5});
    queue.add(odometry(100.0, 0));
    queue.add(at<CObservationImage>(100.04), 0);
    queue.add(odometry(100.05, 1));
    queue.add(at<CObservation2DRangeScan>(100.1));
    EXPECT_TRUE(queue.take(0).empty());
    queue.add(odometry(100.15, 3));
    const auto taken = queue.take(0);
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_NEAR(taken[0].job.T_picture_scan.x(), 2 - 0.8, 1e-4);
}

TEST(CJoinQueue, TakesTheLatencyOfTheCameraOff) {
    CJoinQueue queue({false, false, 0.25, 0.1, 5});
    for (const double time : {100.0, 100.1, 100.2}) queue.add(at<CObservation2DRangeScan>(time));
    queue.add(at<CObservationImage>(100.22), 0);
    const auto taken = queue.take(0);
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_NEAR(timeOf(*taken[0].job.scan), 100.1, 1e-6);
}

TEST(CJoinQueue, WaitsNoLongerThanItMayAndSaysWhatIsMissing) {
    CJoinQueue queue({true, false, 0.25, 0, 0.5});
    queue.add(at<CObservationImage>(100), 10);
    EXPECT_TRUE(queue.take(10.4).empty());
    auto taken = queue.take(10.5);
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken[0].fate, EFate::noScan);
    EXPECT_FALSE(taken[0].T_o_r);
    queue.add(at<CObservation2DRangeScan>(101));
    queue.add(at<CObservationImage>(101), 11);
    taken = queue.take(12);
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken[0].fate, EFate::noHeadPose) << "no answer from the head is no fixed camera";
    queue.add(head(101.5, 0));
    queue.add(at<CObservation2DRangeScan>(103));
    queue.add(at<CObservationImage>(103), 13);
    EXPECT_EQ(queue.take(14).at(0).fate, EFate::noHeadPose) << "too old";
    queue.add(at<CObservation2DRangeScan>(103.5));
    queue.add(at<CObservationImage>(103.8), 15);
    EXPECT_EQ(queue.take(16).at(0).fate, EFate::noScan) << "0.3 s apart";
}

TEST(CJoinQueue, ForgetsWhatWasKnownWhenTheClockGoesBack) {
    CJoinQueue queue({true, true, 0.25, 0, 5});
    queue.add(at<CObservation2DRangeScan>(100));
    queue.add(head(100, 0));
    queue.add(odometry(100, 0));
    queue.add(at<CObservationImage>(100.2), 0);
    queue.add(head(99.9, 0.5));  // set back by 0.3 s or so
    auto taken = queue.take(0);
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken[0].fate, EFate::clockJumped);
    EXPECT_FALSE(taken[0].job.scan);
    // The scan of before the jump is near in stamps, but not in time.
    queue.add(at<CObservationImage>(99.95), 1);
    queue.add(head(100.1, 0.5));
    queue.add(odometry(100.1, 0));
    EXPECT_TRUE(queue.take(1).empty());
    queue.add(at<CObservation2DRangeScan>(100.05));
    taken = queue.take(1);
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken[0].fate, EFate::joined);
    EXPECT_NEAR(timeOf(*taken[0].job.scan), 100.05, 1e-6);
    EXPECT_EQ(queue.jumps(), 1u);
}

TEST(CJoinQueue, ForgivesPicturesThatComeALittleOutOfOrder) {
    CJoinQueue queue({false, false, 0.25, 0, 5});
    queue.add(at<CObservation2DRangeScan>(100.3));
    queue.add(at<CObservationImage>(100.2), 0);
    queue.add(at<CObservationImage>(100.1), 0);
    const auto taken = queue.take(0);
    ASSERT_EQ(taken.size(), 2u);
    EXPECT_EQ(taken[1].fate, EFate::joined);
    queue.add(at<CObservationImage>(90), 0);
    EXPECT_EQ(queue.jumps(), 1u);
}

TEST(CJoinQueue, JoinsWhatComesInOneHeapAfterAStall) {
    CJoinQueue queue({true, true, 0.25, 0, 5});
    for (int i = 0; i < 400; ++i) {  // 40 s
        queue.add(at<CObservation2DRangeScan>(100 + 0.1 * i));
        queue.add(head(100 + 0.1 * i, 0.01 * i));
        queue.add(odometry(100 + 0.1 * i, i));
    }
    for (int i = 0; i < 4; ++i) queue.add(at<CObservationImage>(101.04 + 10 * i), 7);
    const auto taken = queue.take(7);
    ASSERT_EQ(taken.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        const double k = static_cast<double>(i);
        EXPECT_NEAR(timeOf(*taken[i].job.scan), 101 + 10 * k, 1e-6);
        EXPECT_NEAR(taken[i].T_o_r->x(), 10.4 + 100 * k, 1e-4);
    }
}

TEST(CJoinQueue, GivesEveryPictureOnceAndNeverHoldsMany) {
    CJoinQueue queue({false, false, 0.25, 0, 1e9});
    std::size_t taken = 0;
    for (int i = 0; i < 1000; ++i) {
        queue.add(at<CObservationImage>(100 + 0.1 * i), 0);
        if (i % 300 == 299) queue.add(at<CObservation2DRangeScan>(50 + i));  // forwards and back
        taken += queue.take(0).size();
        EXPECT_GE(taken + CJoinQueue::kMostPictures, static_cast<std::size_t>(i + 1));
    }
    taken += queue.take(1e10).size();
    EXPECT_EQ(taken, 1000u);
    EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace salma::sensing
