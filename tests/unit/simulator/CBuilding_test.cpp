// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/simulator/CLaserModel.h>
#include <salma/simulator/CPlaceTruth.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

namespace salma::simulator {
namespace {

using laser::EPlaceClass;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

TEST(CBuilding, IsTheSameForTheSameSeedAndAnotherForAnother) {
    const CBuilding a({}, 5), b({}, 5), c({}, 6);
    ASSERT_EQ(a.segments().size(), b.segments().size());
    for (std::size_t i = 0; i < a.segments().size(); ++i) {
        EXPECT_EQ(a.segments()[i].from, b.segments()[i].from);
        EXPECT_EQ(a.segments()[i].to, b.segments()[i].to);
    }
    EXPECT_NE(a.segments().size(), c.segments().size());
}

TEST(CBuilding, KeepsToItsOptions) {
    TBuildingOptions options;
    options.corridorWidth = {1.7, 1.9};
    options.roomSize = {5, 6};
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        const CBuilding building(options, seed);
        EXPECT_GE(building.corridors().size(), 4u) << seed;
        EXPECT_LE(building.corridors().size(), 9u);
        for (const auto& c : building.corridors()) {
            const TArea& a = c.area;
            const double width = c.alongX ? a.y1 - a.y0 : a.x1 - a.x0;
            EXPECT_TRUE(width > 1.7 - 1e-9 && width < 1.9 + 1e-9) << width;
        }
        for (const auto& a : building.rooms()) {
            EXPECT_TRUE(a.x1 - a.x0 > 5 - 1e-9 && a.x1 - a.x0 < 6 + 1e-9);
            for (const auto& c : building.corridors()) EXPECT_FALSE(a.overlaps(c.area));
        }
    }
}

TEST(CBuilding, HasNothingOnTheWaysBetweenItsStations) {
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        const CBuilding building({}, seed);
        for (const auto& s : building.stations())
            for (const std::size_t next : s.next)
                for (double t = 0; t <= 1; t += 0.05) {
                    const TPoint2D p = s.at + (building.stations()[next].at - s.at) * t;
                    EXPECT_GT(building.clearance(p), 0.3) << seed << " " << p.x << " " << p.y;
                }
    }
}

TEST(CBuilding, IsClosed) {
    TLaserOptions options;
    options.mode = ELaserMode::cm;
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        const CBuilding building({}, seed);
        const CLaserModel laser(options, building.segments(), seed);
        for (const auto& s : building.stations())
            for (const double range : laser.trueRanges({s.at.x, s.at.y, 1}))
                EXPECT_TRUE(std::isfinite(range)) << seed;
    }
}

TEST(CBuilding, RefusesOptionsThatCannotBeBuilt) {
    const auto refused = [](auto edit) {
        TBuildingOptions options;
        edit(options);
        EXPECT_THROW(CBuilding(options, 1), std::invalid_argument);
    };
    refused([](auto& o) { o.corridorWidth = {2, 1.5}; });
    refused([](auto& o) { o.corridorWidth = {0.5, 1.5}; });
    refused([](auto& o) { o.roomSize.max = std::numeric_limits<double>::quiet_NaN(); });
    refused([](auto& o) { o.openShare = 1.5; });
    refused([](auto& o) { o.corridors = 0; });
}

TEST(CBuilding, ARobotWandersInSmallStepsAndHitsNothing) {
    const CBuilding building({}, 3);
    const auto poses = wander(building, 1, 2000);
    ASSERT_EQ(poses.size(), 2000u);
    std::set<std::size_t> visited;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        EXPECT_GT(building.clearance({poses[i].x, poses[i].y}), 0.1);
        for (std::size_t c = 0; c < building.corridors().size(); ++c)
            if (building.corridors()[c].area.contains(poses[i].x, poses[i].y)) visited.insert(c);
        if (i == 0) continue;
        EXPECT_LT(std::hypot(poses[i].x - poses[i - 1].x, poses[i].y - poses[i - 1].y), 0.6);
        EXPECT_LT(std::abs(mrpt::math::wrapToPi(poses[i].phi - poses[i - 1].phi)), 0.6);
    }
    EXPECT_GE(visited.size(), 3u);
}

/// True if `child` leaves from a side of `parent`.
bool beginsAt(const TCorridor& parent, const TCorridor& child) {
    const TArea &p = parent.area, &c = child.area;
    if (parent.alongX == child.alongX) return false;
    if (parent.alongX) return (c.y0 == p.y1 || c.y1 == p.y0) && c.x0 >= p.x0 && c.x1 <= p.x1;
    return (c.x0 == p.x1 || c.x1 == p.x0) && c.y0 >= p.y0 && c.y1 <= p.y1;
}

/// The junction where corridor `child` begins, seen from `distance` [m] before its near edge while
/// the robot drives along `parent` in the direction in which the coordinate grows.
TPose2D before(const TCorridor& parent, const TCorridor& child, double distance) {
    const TArea &p = parent.area, &c = child.area;
    if (parent.alongX) return {c.x0 - distance, (p.y0 + p.y1) / 2, 0};
    return {(p.x0 + p.x1) / 2, c.y0 - distance, M_PI / 2};
}

TEST(placeAt, AgreesWithTheScanner) {
    // without doors and furniture the scan itself shows whether a way leads on
    TBuildingOptions options;
    options.openShare = 0;
    options.clutterPerMetre = 0;
    options.clutterPerRoom = 0;
    TLaserOptions laserOptions;
    laserOptions.x = 0;
    std::set<EPlaceClass> seen;
    std::size_t checked = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const CBuilding building(options, seed);
        const CLaserModel laser(laserOptions, building.segments(), seed);
        for (const auto& parent : building.corridors())
            for (const auto& child : building.corridors()) {
                if (!beginsAt(parent, child)) continue;
                const TPose2D pose = before(parent, child, 1.2);
                if (!parent.area.contains(pose.x, pose.y)) continue;
                const auto truth = placeAt(building, pose);
                if (!truth.place) continue;
                seen.insert(*truth.place);
                ++checked;
                // ahead, and obliquely into a way that begins 1.2 m ahead on either side
                const auto ranges = laser.trueRanges(pose);
                const double half = (parent.alongX ? parent.area.y1 - parent.area.y0
                                                   : parent.area.x1 - parent.area.x0) /
                                    2;
                const double steep = std::atan2(half, 1.2 + 0.7);
                const auto beam = [&](double bearing) {
                    return ranges[static_cast<std::size_t>(
                        std::round((bearing + M_PI / 2) / (M_PI / 360)))];
                };
                const double side = std::hypot(half, 1.9) + 0.25;
                const bool left = beam(steep) > side, right = beam(-steep) > side;
                const bool on = beam(0) > 5;
                switch (*truth.place) {
                    case EPlaceClass::teeLeft:
                        EXPECT_TRUE(left && !right && on) << seed;
                        break;
                    case EPlaceClass::teeRight:
                        EXPECT_TRUE(!left && right && on) << seed;
                        break;
                    case EPlaceClass::bendLeft:
                        EXPECT_TRUE(left && !right && !on) << seed;
                        break;
                    case EPlaceClass::bendRight:
                        EXPECT_TRUE(!left && right && !on) << seed;
                        break;
                    case EPlaceClass::teeAhead:
                        EXPECT_TRUE(left && right && !on) << seed;
                        break;
                    default:
                        break;
                }
            }
    }
    EXPECT_GT(checked, 30u);
    for (const auto place : {EPlaceClass::teeLeft, EPlaceClass::teeRight, EPlaceClass::bendLeft,
                             EPlaceClass::bendRight, EPlaceClass::teeAhead})
        EXPECT_EQ(seen.count(place), 1u) << asString(place);
}

TEST(placeAt, HasNoClassBetweenTwo) {
    TBuildingOptions options;
    options.corridors = 1;
    options.corridorLength = {10, 10};  // the first is half as long again
    const CBuilding building(options, 1);
    const auto at = [&](double x, double phi) { return placeAt(building, {x, 0, phi}); };
    EXPECT_EQ(at(2, 0).place, EPlaceClass::corridor);
    EXPECT_EQ(at(14, 0).place, EPlaceClass::deadEnd);
    const auto approach = at(12.2, 0);  // 2.8 m before the end
    EXPECT_FALSE(approach.place);
    EXPECT_EQ(approach.doubt, EPlaceDoubt::approach);
    EXPECT_EQ(approach.either,
              (std::vector<EPlaceClass>{EPlaceClass::corridor, EPlaceClass::deadEnd}));
    EXPECT_EQ(at(5, M_PI / 4).doubt, EPlaceDoubt::across);
    EXPECT_EQ(at(5, M_PI / 2).doubt, EPlaceDoubt::across);
    EXPECT_EQ(at(14, M_PI).place, EPlaceClass::corridor);
}

}  // namespace
}  // namespace salma::simulator
