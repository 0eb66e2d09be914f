// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/laser/CPlaneExtractor.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "CTemporaryFolder.h"
#include "corridorSweep.h"
#include "heaterScenes.h"

namespace salma::laser {
namespace {

using Sweep = std::vector<mrpt::obs::CObservation2DRangeScan>;

/// A sweep of an empty box: walls at x = 3, y = +-2, floor at 0, ceiling at 2.5, scanner at 0.4 m.
Sweep boxSweep(double noise, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, noise);
    Sweep sweep;
    for (int elevation = -20; elevation <= 40; ++elevation) {
        mrpt::obs::CObservation2DRangeScan scan;
        scan.aperture = static_cast<float>(M_PI);
        scan.maxRange = 80;
        scan.stdError = 0.005F;
        scan.sensorPose = mrpt::poses::CPose3D(0, 0, 0.4, 0, -elevation * M_PI / 180, 0);
        scan.resizeScan(181);
        for (std::size_t i = 0; i < 181; ++i) {
            const double bearing = (static_cast<double>(i) - 90) * scan.aperture / 180;
            double x = 0, y = 0, z = 0;
            scan.sensorPose.composePoint(std::cos(bearing), std::sin(bearing), 0, x, y, z);
            z -= 0.4;
            double range = std::min(x > 1e-9 ? 3 / x : 1e9, 2 / std::max(std::abs(y), 1e-9));
            range = std::min(range, z < 0 ? -0.4 / z : 2.1 / std::max(z, 1e-9));
            scan.setScanRange(i, static_cast<float>(range + normal(random)));
            scan.setScanRangeValidity(i, true);
        }
        sweep.push_back(scan);
    }
    return sweep;
}

/// The plane nearest to (normal, distance); nothing if none is near.
std::optional<TPlanePatch> find(const TPlaneResult& result,
                                const Eigen::Vector3d& normal,
                                double distance) {
    for (const TPlanePatch& plane : result.planes)
        if (plane.normal.dot(normal) > 0.99 && std::abs(plane.distance - distance) < 0.1)
            return plane;
    return std::nullopt;
}

std::string messageOf(const Sweep& sweep) {
    try {
        CPlaneExtractor().extract(sweep);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST(CPlaneExtractor, FindsTheSidesOfABox) {
    const TPlaneResult result = CPlaneExtractor().extract(boxSweep(0.005, 1));
    struct TSide {
        Eigen::Vector3d normal;
        double distance;
        EPlaneKind kind;
    };
    const TSide sides[] = {{{1, 0, 0}, 3, EPlaneKind::wall},
                           {{0, 1, 0}, 2, EPlaneKind::wall},
                           {{0, -1, 0}, 2, EPlaneKind::wall},
                           {{0, 0, 1}, 2.5, EPlaneKind::ceiling}};
    for (const TSide& side : sides) {
        const auto plane = find(result, side.normal, side.distance);
        ASSERT_TRUE(plane) << side.normal.transpose();
        EXPECT_NEAR(plane->distance, side.distance, 0.003);
        EXPECT_GT(plane->normal.dot(side.normal), 0.99999);
        EXPECT_EQ(plane->kind, side.kind);
        EXPECT_NEAR(plane->normal.dot(plane->across), 0, 1e-12);
        EXPECT_NEAR(plane->normal.cross(plane->across).dot(plane->up), 1, 1e-9);
    }
    const bool floor =
        std::any_of(result.planes.begin(), result.planes.end(), [](const TPlanePatch& plane) {
            return plane.kind == EPlaneKind::floor && std::abs(plane.distance) < 0.01;
        });
    EXPECT_TRUE(floor);
    const auto ahead = find(result, {1, 0, 0}, 3);
    EXPECT_NEAR(ahead->size().x(), 4, 0.15);  // from side to side
    EXPECT_NEAR(ahead->size().y(), 2.5, 0.2);
}

/// The wall ahead, over sweeps; the noise has no error of bearing, which the options assume.
TEST(CPlaneExtractor, StatesACovarianceThatTheErrorsHave) {
    TPlaneOptions options;
    options.bearingSigma = 0;
    const CPlaneExtractor extractor(options);
    double nees = 0;
    constexpr int kRuns = 60;
    for (std::uint32_t seed = 1; seed <= kRuns; ++seed) {
        const auto plane = find(extractor.extract(boxSweep(0.005, seed)), {1, 0, 0}, 3);
        ASSERT_TRUE(plane);
        const Eigen::Vector3d normal(1, 0, 0);
        const Eigen::Vector3d error(plane->across.dot(normal), plane->up.dot(normal),
                                    3 - plane->distance);
        nees += error.dot(plane->covariance.ldlt().solve(error)) / kRuns;
    }
    // mean of chi-square(3) over 60 runs: 3 +- 0.62
    EXPECT_GT(nees, 2.38);
    EXPECT_LT(nees, 3.62);
}

/// docs/laser.md has more scenes.
TEST(CPlaneExtractor, TellsHeatersFromWalls) {
    const CPlaneExtractor extractor;
    for (std::uint32_t seed = 9001; seed <= 9012; ++seed) {
        const auto scene = test::heaterScene({}, seed);
        const auto verdict = judge(scene, extractor.extract(scene.sweep));
        EXPECT_TRUE(verdict.right()) << seed;
        EXPECT_TRUE(verdict.falseWall2D) << seed << ": the level scan shows no false wall";
    }
}

TEST(CPlaneExtractor, GivesTheSamePlanesEachTime) {
    const Sweep sweep = boxSweep(0.005, 3);
    const CPlaneExtractor extractor;
    const TPlaneResult a = extractor.extract(sweep), b = extractor.extract(sweep);
    ASSERT_EQ(a.planes.size(), b.planes.size());
    for (std::size_t i = 0; i < a.planes.size(); ++i) {
        EXPECT_EQ(a.planes[i].distance, b.planes[i].distance);
        EXPECT_EQ(a.planes[i].normal, b.planes[i].normal);
    }
}

TEST(CPlaneExtractor, FindsNothingWhereThereIsNothing) {
    EXPECT_TRUE(CPlaneExtractor().extract({}).planes.empty());
    Sweep dark = boxSweep(0, 1), constant = dark, nan = dark;
    for (std::size_t k = 0; k < dark.size(); ++k)
        for (std::size_t i = 0; i < 181; ++i) {
            dark[k].setScanRangeValidity(i, false);
            constant[k].setScanRange(i, 2);
            nan[k].setScanRange(i, std::numeric_limits<float>::quiet_NaN());
        }
    for (const Sweep& sweep : {dark, constant, nan}) {
        const TPlaneResult result = CPlaneExtractor().extract(sweep);
        EXPECT_TRUE(result.planes.empty());
        EXPECT_EQ(result.scansWithoutLines, sweep.size());
    }
    EXPECT_TRUE(CPlaneExtractor().extract({boxSweep(0.005, 1).front()}).planes.empty());
}

TEST(CPlaneExtractor, NamesTheScanThatCannotBeUsed) {
    Sweep sweep = boxSweep(0.005, 1);
    sweep[3].resizeScan(100);
    EXPECT_EQ(messageOf(sweep), "scan 3 of the sweep has 100 readings, the first 181");
    sweep = boxSweep(0.005, 1);
    sweep[7].sensorPose = mrpt::poses::CPose3D(0, std::nan(""), 0, 0, 0, 0);
    EXPECT_EQ(messageOf(sweep), "scan 7 of the sweep has a pose that is not finite");
    sweep = boxSweep(0.005, 1);
    sweep[0].aperture = 0;
    EXPECT_EQ(messageOf(sweep).substr(0, 31), "scan 0 of the sweep has an aper");
    TPlaneOptions options;
    options.gap = 0;
    EXPECT_THROW(CPlaneExtractor{options}, std::invalid_argument);
}

/// Of the middle of a piece from another's plane [m]: far from the origin a small error of a
/// normal makes a large one of the distance.
double offsetOfMiddle(const TPlanePatch& piece, const TPlanePatch& wall) {
    const Eigen::Vector2d middle = 0.5 * (piece.low + piece.high);
    return wall.normal.dot(piece.distance * piece.normal + middle[0] * piece.across +
                           middle[1] * piece.up) -
           wall.distance;
}

/// The piece of a plane parallel to `wall` whose middle is `away` from it [m], within 3 cm.
std::optional<TPlanePatch> parallelAt(const TPlaneResult& result,
                                      const TPlanePatch& wall,
                                      double away) {
    for (const TPlanePatch& plane : result.planes)
        if (std::abs(plane.normal.dot(wall.normal)) > 0.99 &&
            std::abs(offsetOfMiddle(plane, wall) - away) < 0.03)
            return plane;
    return std::nullopt;
}

/** Two sweeps 1.57 m apart along a corridor. Its left side is glass between frames, with a solid
 * wall behind; on its right doors stand 0.24 m back. */
TEST(CPlaneExtractor, FindsWallsAndFloorOfARealCorridorTwiceInTheSamePlace) {
    double glassFront[2] = {0, 0}, solidWall[2] = {0, 0};
    for (const int k : {0, 1}) {
        SALMA_NEED_DATA(file, "scans3d/scan00" + std::to_string(k) + ".3d.gz");
        const TPlaneResult result = CPlaneExtractor().extract(test::readCorridorSweep(file));
        const auto right = find(result, {0, -1, 0}, 0.97);
        ASSERT_TRUE(right) << k;
        EXPECT_EQ(right->kind, EPlaneKind::wall);
        const auto front = parallelAt(result, *right, -2.36),
                   solid = parallelAt(result, *right, -4.74);
        ASSERT_TRUE(front && solid) << k;
        EXPECT_EQ(front->kind, EPlaneKind::wall);
        EXPECT_GT(front->size().minCoeff(), 2) << "from floor to ceiling";
        EXPECT_EQ(solid->kind, EPlaneKind::wall);
        EXPECT_TRUE(parallelAt(result, *right, 0.24)) << "door of sweep " << k;
        glassFront[k] = offsetOfMiddle(*front, *right);
        solidWall[k] = offsetOfMiddle(*solid, *right);
        const bool floor =
            std::any_of(result.planes.begin(), result.planes.end(), [](const TPlanePatch& plane) {
                return plane.kind == EPlaneKind::floor && plane.points > 5000;
            });
        EXPECT_TRUE(floor) << k;
    }
    EXPECT_NEAR(glassFront[0], glassFront[1], 0.02);
    EXPECT_NEAR(solidWall[0], solidWall[1], 0.02);
}

}  // namespace salma::laser
