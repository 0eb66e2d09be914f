// SPDX-License-Identifier: BSD-3-Clause
#include "CMapping.h"

#include <gtest/gtest.h>

#include <cmath>

namespace salma::apps {
namespace {

using mrpt::obs::CObservation2DRangeScan;

/// Finds out in the end that the robot was at one pose all the time.
class CFixedBackend : public slam::CSlamBackend {
 public:
    explicit CFixedBackend(const mrpt::poses::CPose2D& pose) : m_pose(pose) {}
    void process(const slam::TStepInput& /*step*/) override { ++steps; }
    mrpt::poses::CPosePDFGaussian pose() const override { return {}; }
    void results(slam::TRunRecord& record) const override {
        record.trajectory.assign(static_cast<std::size_t>(steps), {});
        for (auto& row : record.trajectory) row.pose = m_pose;
    }

    int steps{0};

 private:
    mrpt::poses::CPose2D m_pose;
};

/// A scan of 180 degrees, counter-clockwise, by a scanner at the robot's origin.
CObservation2DRangeScan::Ptr scanOf(const std::vector<float>& ranges) {
    const auto scan = CObservation2DRangeScan::Create();
    scan->aperture = static_cast<float>(M_PI);
    scan->maxRange = 20;
    scan->rightToLeft = true;
    scan->resizeScan(ranges.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        scan->setScanRange(i, ranges[i]);
        scan->setScanRangeValidity(i, ranges[i] > 0);
    }
    return scan;
}

/// Points of the walls that a run keeps of one scan from (1, 2), heading along y.
std::vector<mrpt::math::TPoint2D> pointsOf(const CObservation2DRangeScan::Ptr& scan) {
    observations::TLog log;
    log.hasOdometry = true;
    log.steps.resize(1);
    log.steps[0].observations = {scan};
    const TSlamConfig config;
    CFixedBackend backend(mrpt::poses::CPose2D(1, 2, M_PI_2));
    slam::TRunRecord record;
    CMapping(config, log, backend).run({}, record);
    EXPECT_EQ(backend.steps, 1);
    return record.scanPoints;
}

void expectPoint(const mrpt::math::TPoint2D& p, double x, double y) {
    EXPECT_NEAR(p.x, x, 1e-6);
    EXPECT_NEAR(p.y, y, 1e-6);
}

TEST(CMapping, KeepsEveryFourthPointWhereTheScanPutsIt) {
    // beams at -90, -67.5, ..., 90 degrees from the heading: right, ahead and left are kept
    const auto points = pointsOf(scanOf({3, 9, 9, 9, 5, 9, 9, 9, 2}));
    ASSERT_EQ(points.size(), 3U);
    expectPoint(points[0], 1 + 3, 2);
    expectPoint(points[1], 1, 2 + 5);
    expectPoint(points[2], 1 - 2, 2);
}

TEST(CMapping, TurnsAClockwiseScanRound) {
    const auto scan = scanOf({3, 9, 9, 9, 5, 9, 9, 9, 2});
    scan->rightToLeft = false;
    const auto points = pointsOf(scan);
    ASSERT_EQ(points.size(), 3U);
    expectPoint(points[0], 1 - 3, 2);
    expectPoint(points[2], 1 + 2, 2);
}

TEST(CMapping, KeepsNoPointOfABeamWithoutEcho) {
    const auto points = pointsOf(scanOf({0, 9, 9, 9, 5}));
    ASSERT_EQ(points.size(), 1U);
    expectPoint(points[0], 1 - 5, 2);
}

TEST(CMapping, TakesAScanOfOneBeamAndOfNone) {
    const auto points = pointsOf(scanOf({3}));
    ASSERT_EQ(points.size(), 1U);
    expectPoint(points[0], 1 + 3, 2);  // the first beam, at the right end of the field
    EXPECT_TRUE(pointsOf(scanOf({})).empty());
}

}  // namespace
}  // namespace salma::apps
