// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/laser/CCornerExtractor.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lineScore.h"
#include "segmentWorld.h"
#include "simulatedScans.h"

namespace salma::laser {
namespace {

using mrpt::poses::CPose2D;
using simulator::ELaserMode;
using simulator::EResolution;
using test::castScan;

/// An LMS 200 in millimetre mode whose noise is that of sickOptions().
const test::TScanner kSick{361, M_PI, 0.005, 0.001, 0.05 * M_PI / 180};

TLineOptions sickOptions() {
    TLineOptions options;
    options.rangeQuantum = 0.001;
    return options;
}

/// Mean of samples, and the half width of its 95 % interval.
class CMean {
 public:
    void add(double x) {
        ++m_count;
        m_sum += x;
        m_squares += x * x;
    }
    double mean() const { return m_sum / m_count; }
    double halfWidth() const {
        return 1.96 * std::sqrt((m_squares / m_count - mean() * mean()) / m_count);
    }
    void expectIn(double value) const {
        EXPECT_NEAR(mean(), value, halfWidth()) << m_count << " samples";
    }

 private:
    double m_count{0}, m_sum{0}, m_squares{0};
};

/// Scores of RANSAC and of split and merge.
std::array<test::TLineScore, 2> scoresOf(EResolution resolution, ELaserMode mode) {
    simulator::TLaserOptions laser;
    laser.resolution = resolution;
    laser.mode = mode;
    std::array<TLineOptions, 2> options;
    options[1].method = ELineMethod::splitMerge;
    std::array<test::TLineScore, 2> scores;
    for (std::uint32_t seed = 901; seed <= 904; ++seed)
        for (const auto& s : test::simulatedScans(laser, seed, 30))
            for (const int k : {0, 1})
                addScore(CLineExtractor(options[k]).extract(s.scan),
                         trueLines(s.walls, s.hits, s.scan, options[k]), {}, scores[k]);
    return scores;
}

}  // namespace

/// docs/laser.md has more scans; the buildings here are others than those it was tuned on.
TEST(lineQuality, FindsNearlyAllWallsAndHardlyAnyOther) {
    for (const EResolution resolution : {EResolution::half, EResolution::one})
        for (const ELaserMode mode : {ELaserMode::mm, ELaserMode::cm})
            for (const test::TLineScore& score : scoresOf(resolution, mode)) {
                EXPECT_GT(score.required, 300U);
                EXPECT_LE(score.falsePart(), 0.06);
                EXPECT_LE(score.missedPart(), 0.06);
            }
}

/// The score itself: a wall that is not there, one in two parts, one that is passed over.
TEST(lineQuality, ScoreCountsWhatIsWrong) {
    std::mt19937 random(1);
    const test::TWorld room = test::polygon({{-3, -2}, {3, -2}, {3, 2}, {-3, 2}});
    auto scan = castScan(room, CPose2D(), {361, M_PI}, random);
    std::vector<test::TTrueWall> walls;
    for (const auto& s : room) walls.push_back({s.a, s.b});
    std::vector<int> hits;
    for (int i = 0; i < 361; ++i)
        hits.push_back(
            static_cast<int>(test::castRay(room, CPose2D(0, 0, (i - 180) * M_PI / 360)).segment));
    const auto truth = trueLines(walls, hits, scan, {});
    ASSERT_EQ(truth.size(), 3U);
    TLineResult lines = CLineExtractor().extract(scan);
    test::TLineScore right;
    addScore(lines, truth, {}, right);
    EXPECT_EQ(right.required, 3U);
    EXPECT_EQ(right.found, 3U);
    EXPECT_EQ(right.wrong, 0U);

    TLineResult shifted = lines;
    shifted.lines[1].from.x += 0.1;
    test::TLineScore wrong;
    addScore(shifted, truth, {}, wrong);
    EXPECT_EQ(wrong.found, 2U);
    EXPECT_EQ(wrong.wrong, 1U);

    TLineResult twice = lines;
    twice.lines.push_back(lines.lines[0]);
    test::TLineScore doubled;
    addScore(twice, truth, {}, doubled);
    EXPECT_EQ(doubled.found, 3U);
    EXPECT_EQ(doubled.wrong, 1U);

    TLineResult fewer = lines;
    fewer.lines.pop_back();
    test::TLineScore missed;
    addScore(fewer, truth, {}, missed);
    EXPECT_NEAR(missed.missedPart(), 1.0 / 3, 1e-12);
    EXPECT_EQ(missed.wrong, 0U);
}

TEST(lineQuality, NeesOfLinesLiesInItsInterval) {
    const test::TWorld wall{{{2, -1.5}, {2, 1.5}}};
    for (const ELineMethod method : {ELineMethod::ransac, ELineMethod::splitMerge}) {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> unit(-1, 1);
        TLineOptions options = sickOptions();
        options.method = method;
        const CLineExtractor extractor(options);
        CMean nees;
        for (int i = 0; i < 2000; ++i) {
            const CPose2D pose(unit(random), unit(random), 0.8 * unit(random));
            const auto lines = extractor.extract(castScan(wall, pose, kSick, random)).lines;
            ASSERT_GE(lines.size(), 1U);
            const TLine seen = transformed(*std::max_element(lines.begin(), lines.end(),
                                                             [](const TLine& a, const TLine& b) {
                                                                 return a.points < b.points;
                                                             }),
                                           pose);
            const Eigen::Vector2d error(seen.rho - 2, mrpt::math::wrapToPi(seen.alpha));
            nees.add(error.dot(seen.covariance.inverse() * error));
        }
        nees.expectIn(2);
    }
}

TEST(lineQuality, NeesOfCornersOfWallsLiesInItsInterval) {
    const std::vector<mrpt::math::TPoint2D> corners{{3, -2}, {3, 2}};
    const test::TWorld room = test::polygon({{-3, -2}, {3, -2}, {3, 2}, {-3, 2}});
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit(-1, 1);
    TCornerOptions options;
    options.sigmaFloor = 0;
    options.lineEnds = false;
    const CLineExtractor extractor(sickOptions());
    const CCornerExtractor cornerExtractor(options);
    CMean nees;
    for (int i = 0; i < 1500; ++i) {
        const CPose2D pose(unit(random), unit(random), 0.3 * unit(random));
        for (const TCorner& corner :
             cornerExtractor.extract(extractor.extract(castScan(room, pose, kSick, random)))
                 .corners) {
            mrpt::math::TPoint2D p;
            pose.composePoint(corner.position.x, corner.position.y, p.x, p.y);
            if (p.x < 0) continue;  // near the end of the view
            const auto& truth = corners[p.y < 0 ? 0 : 1];
            const Eigen::Vector2d error =
                Eigen::Rotation2Dd(-pose.phi()) * Eigen::Vector2d(p.x - truth.x, p.y - truth.y);
            nees.add(error.dot(corner.covariance.inverse() * error));
        }
    }
    nees.expectIn(2);
}

/// An end lies anywhere between two beams: its error along the wall is uniform.
TEST(lineQuality, NeesOfLineEndsLiesInItsInterval) {
    const test::TWorld world{{{6, -9}, {6, 9}}, {{2, -1}, {2, 0.7}}};
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(-1, 1);
    TCornerOptions options;
    options.sigmaFloor = 0;
    const CLineExtractor extractor(sickOptions());
    const CCornerExtractor cornerExtractor(options);
    CMean nees;
    for (int i = 0; i < 1500; ++i) {
        const CPose2D pose(0.5 * unit(random), 0.8 * unit(random), 0.2 * unit(random));
        const auto lines = extractor.extract(castScan(world, pose, kSick, random));
        for (const TCorner& edge : cornerExtractor.extract(lines).corners) {
            mrpt::math::TPoint2D p;
            pose.composePoint(edge.position.x, edge.position.y, p.x, p.y);
            if (p.x > 3) continue;
            const Eigen::Vector2d error = Eigen::Rotation2Dd(-pose.phi()) *
                                          Eigen::Vector2d(p.x - 2, p.y < 0 ? p.y + 1 : p.y - 0.7);
            nees.add(error.dot(edge.covariance.inverse() * error));
        }
    }
    nees.expectIn(2);
}

TEST(lineQuality, FindsNothingInScansThatNoWallCanGive) {
    const CLineExtractor extractor;
    std::mt19937 random(1);
    const test::TWorld room = test::polygon({{-3, -2}, {3, -2}, {3, 2}, {-3, 2}});
    const auto good = castScan(room, CPose2D(), kSick, random);
    auto constant = good, notANumber = good, aperture = good, place = good;
    for (std::size_t i = 0; i < 361; ++i) {
        constant.setScanRange(i, 2);
        notANumber.setScanRange(i, std::numeric_limits<float>::quiet_NaN());
    }
    EXPECT_TRUE(extractor.extract(constant).constant);
    EXPECT_TRUE(extractor.extract(constant).lines.empty());
    EXPECT_EQ(extractor.extract(notANumber).invalidPoints, 361U);
    EXPECT_TRUE(extractor.extract(notANumber).lines.empty());
    for (const float angle : {0.0F, -1.0F, 7.0F, std::numeric_limits<float>::quiet_NaN()}) {
        aperture.aperture = angle;
        EXPECT_TRUE(extractor.extract(aperture).badGeometry) << angle;
        EXPECT_TRUE(extractor.extract(aperture).lines.empty()) << angle;
    }
    place.sensorPose = mrpt::poses::CPose3D(std::nan(""), 0, 0, 0, 0, 0);
    EXPECT_TRUE(extractor.extract(place).badGeometry);
    EXPECT_TRUE(extractor.extract(place).lines.empty());
    mrpt::obs::CObservation2DRangeScan one;
    one.resizeScan(1);
    one.setScanRange(0, 1);
    one.setScanRangeValidity(0, true);
    EXPECT_TRUE(extractor.extract(one).lines.empty());
}

/// The same readings from left to right, said so.
TEST(lineQuality, ReadsAReversedScanLikeTheScanItself) {
    std::mt19937 random(4);
    const auto scan =
        castScan(test::polygon(test::corridorOutline()), CPose2D(1, 0.2, 0.4), kSick, random);
    auto reversed = scan;
    reversed.rightToLeft = false;
    for (std::size_t i = 0; i < 361; ++i) {
        reversed.setScanRange(i, scan.getScanRange(360 - i));
        reversed.setScanRangeValidity(i, scan.getScanRangeValidity(360 - i));
    }
    for (const ELineMethod method : {ELineMethod::ransac, ELineMethod::splitMerge}) {
        TLineOptions options;
        options.method = method;
        const auto a = CLineExtractor(options).extract(scan).lines;
        const auto b = CLineExtractor(options).extract(reversed).lines;
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_NEAR(a[i].rho, b[i].rho, 1e-5);
            EXPECT_NEAR(mrpt::math::wrapToPi(a[i].alpha - b[i].alpha), 0, 1e-5);
            EXPECT_EQ(a[i].firstPoint, 360 - b[i].lastPoint);
        }
    }
}

}  // namespace salma::laser
