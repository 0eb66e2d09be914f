// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/laser/CPlaceDistance.h>
#include <salma/laser/CPlaceString.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "segmentWorld.h"

namespace salma::laser {
namespace {

using mrpt::poses::CPose2D;
using observations::asText;
using observations::parsePlaceString;
using observations::TPlaceLetter;
using observations::TPlaceString;
using test::polygon;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TPlaceString stringOf(const mrpt::obs::CObservation2DRangeScan& scan) {
    return CPlaceString().describe(scan, CLineExtractor().extract(scan));
}

/// As an LMS 200 in millimetre mode sees it; what is beyond 8 m gives no echo.
TPlaceString stringAt(const test::TWorld& world, const CPose2D& pose, std::uint32_t seed = 1) {
    std::mt19937 random(seed);
    test::TScanner scanner;
    scanner.beams = 181;
    scanner.sigma = 0.005;
    scanner.quantum = 0.001;
    auto scan = test::castScan(world, pose, scanner, random);
    for (std::size_t i = 0; i < scan.getScanSize(); ++i)
        if (scan.getScanRange(i) > 8) scan.setScanRangeValidity(i, false);
    return stringOf(scan);
}

std::string letters(const TPlaceString& place) {
    std::string text;
    for (const TPlaceLetter& l : place) text += l.letter;
    return text;
}

/// A corridor 2 m wide that bends to the left at x = 3; a door to the right from x = 1 to 1.9 that
/// opens into a room.
test::TWorld bend() {
    return polygon({{-9, -1},
                    {1, -1},
                    {1, -1.2},
                    {-2, -1.2},
                    {-2, -6},
                    {4, -6},
                    {4, -1.2},
                    {1.9, -1.2},
                    {1.9, -1},
                    {5, -1},
                    {5, 9},
                    {3, 9},
                    {3, 1},
                    {-9, 1}});
}

TEST(CPlaceString, ReadsADeadEndFromRightToLeft) {
    const auto world = polygon({{-9, -1}, {3, -1}, {3, 1}, {-9, 1}});
    const TPlaceString place = stringAt(world, {0, 0, 0});
    ASSERT_EQ(letters(place), "WcWcW");
    EXPECT_NEAR(place[0].value, 3, 0.05);
    EXPECT_GT(place[0].sigma, 1);  // the scan's field ends there, not the wall
    EXPECT_NEAR(place[2].value, 2, 0.03);
    EXPECT_LT(place[2].sigma, 0.2);
}

TEST(CPlaceString, MeasuresOpenings) {
    const TPlaceString place = stringAt(bend(), {0, 0, 0});
    // right wall, door with the room behind it, right wall, far wall of the bend, left wall
    std::vector<double> widths;
    for (const TPlaceLetter& l : place)
        if (l.letter == 'O') widths.push_back(l.value);
    ASSERT_EQ(widths.size(), 2u) << asText(place);
    EXPECT_NEAR(widths[0], 0.9, 0.15) << asText(place);
    EXPECT_NEAR(widths[1], 2, 0.15) << asText(place);
    EXPECT_EQ(std::count_if(place.begin(), place.end(),
                            [](const TPlaceLetter& l) { return l.letter == 'J'; }),
              3)
        << asText(place);
}

TEST(CPlaceString, SeesConvexCornersAndWhereNothingComesBack) {
    // a corridor without an end, a pillar at its left wall
    const auto world =
        polygon({{-20, -1}, {40, -1}, {40, 1}, {3, 1}, {3, 0.3}, {2, 0.3}, {2, 1}, {-20, 1}});
    const TPlaceString place = stringAt(world, {0, -0.2, 0});
    EXPECT_EQ(letters(place).substr(0, 3), "WXW") << asText(place);
    EXPECT_NE(letters(place).find("C"), std::string::npos) << asText(place);
}

TEST(CPlaceString, PassesOverShutDoorsAndPeople) {
    auto corridor = polygon(test::corridorOutline());  // recesses 0.12 m deep
    const TPlaceString empty = stringAt(corridor, {0, 0, 0});
    EXPECT_EQ(letters(empty), "WXW") << asText(empty);
    for (const auto& leg : polygon({{1.5, -0.7}, {1.6, -0.7}, {1.6, -0.6}, {1.5, -0.6}}))
        corridor.push_back(leg);
    EXPECT_LT(CPlaceDistance()(stringAt(corridor, {0, 0, 0}), empty), 0.1);
}

TEST(CPlaceString, StaysTheSameUnderNoiseTurnsAndSmallMotion) {
    const CPlaceDistance distance;
    const CPose2D here(0, 0, 0);
    const TPlaceString place = stringAt(bend(), here);
    const double toDeadEnd =
        distance(place, stringAt(polygon({{-9, -1}, {3, -1}, {3, 1}, {-9, 1}}), here));
    double noise = 0, motion = 0, turn = 0;
    for (std::uint32_t seed = 2; seed < 32; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> u(-1, 1);
        noise = std::max(noise, distance(place, stringAt(bend(), here, seed)));
        motion = std::max(
            motion, distance(place, stringAt(bend(), {0.1 * u(random), 0.1 * u(random), 0}, seed)));
        turn = std::max(turn, distance(place, stringAt(bend(), {0, 0, 0.35 * u(random)}, seed)));
    }
    EXPECT_LT(noise, 0.15);
    EXPECT_LT(motion, 0.2);  // 0.1 m
    EXPECT_LT(turn, 0.2);    // 20 deg: the field begins and ends elsewhere
    EXPECT_GT(toDeadEnd, 0.3);
}

TEST(CPlaceString, TakesScansInEitherOrder) {
    std::mt19937 random(1);
    const auto scan = test::castScan(bend(), {0, 0, 0}, {}, random);
    auto reversed = scan;
    reversed.rightToLeft = false;
    for (std::size_t i = 0; i < scan.getScanSize(); ++i)
        reversed.setScanRange(i, scan.getScanRange(scan.getScanSize() - 1 - i));
    EXPECT_EQ(letters(stringOf(scan)), letters(stringOf(reversed)));
}

TEST(CPlaceString, DescribesNothingWhereNothingIsSeen) {
    std::mt19937 random(1);
    const auto good = test::castScan(bend(), {0, 0, 0}, {}, random);
    const auto edited = [&](auto edit) {
        auto scan = good;
        edit(scan);
        return stringOf(scan);
    };
    EXPECT_TRUE(edited([](auto& s) { s.resizeScan(0); }).empty());
    EXPECT_TRUE(edited([](auto& s) { s.sensorPose.setYawPitchRoll(0, 1, 0); }).empty());
    for (const float value : {0.0F, -1.0F, std::nanf(""), std::numeric_limits<float>::infinity()})
        EXPECT_TRUE(edited([&](auto& s) {
                        for (std::size_t i = 0; i < s.getScanSize(); ++i) s.setScanRange(i, value);
                    }).empty())
            << value;
    EXPECT_TRUE(edited([](auto& s) {
                    for (std::size_t i = 0; i < s.getScanSize(); ++i)
                        s.setScanRangeValidity(i, false);
                }).empty());
    std::uniform_real_distribution<float> any(-1, 9);
    for (int round = 0; round < 50; ++round) {  // nonsense gives some string that can be written
        const auto place = edited([&](auto& s) {
            s.resizeScan(1 + random() % 300);
            for (std::size_t i = 0; i < s.getScanSize(); ++i)
                s.setScanRange(i, round == 0 ? 3.0F : any(random));
        });
        EXPECT_NO_THROW(asText(place));
    }
}

/// The definition, with a whole matrix: best cost of a[i..] and b[j..], ends counted explicitly.
double plainDistance(const CPlaceDistance& distance, const TPlaceString& a, const TPlaceString& b) {
    const std::size_t m = a.size(), n = b.size();
    const auto f = static_cast<std::size_t>(distance.options().freeShare *
                                            static_cast<double>(std::min(m, n)));
    double total = 0;
    for (const auto* s : {&a, &b})
        for (const TPlaceLetter& l : *s) total += distance.gapCost(l);
    if (total == 0) return 0;
    double best = kInfinity;
    // letters that stick out: at either end those of one of the two strings
    for (std::size_t head = 0; head <= f; ++head)
        for (std::size_t tail = 0; tail <= f; ++tail)
            for (const bool headOfA : {true, false})
                for (const bool tailOfA : {true, false}) {
                    const std::size_t a0 = headOfA ? head : 0, a1 = m - (tailOfA ? tail : 0);
                    const std::size_t b0 = headOfA ? 0 : head, b1 = n - (tailOfA ? 0 : tail);
                    if (a0 > a1 || b0 > b1) continue;
                    std::vector<std::vector<double>> d(m + 1,
                                                       std::vector<double>(n + 1, kInfinity));
                    d[a0][b0] = 0;
                    for (std::size_t i = a0; i <= a1; ++i)
                        for (std::size_t j = b0; j <= b1; ++j) {
                            if (i > a0)
                                d[i][j] =
                                    std::min(d[i][j], d[i - 1][j] + distance.gapCost(a[i - 1]));
                            if (j > b0)
                                d[i][j] =
                                    std::min(d[i][j], d[i][j - 1] + distance.gapCost(b[j - 1]));
                            if (i > a0 && j > b0)
                                d[i][j] =
                                    std::min(d[i][j], d[i - 1][j - 1] + CPlaceDistance::changeCost(
                                                                            a[i - 1], b[j - 1]));
                        }
                    best = std::min(best, d[a1][b1]);
                }
    return std::min(best / total, 1.0);
}

TPlaceString randomString(std::mt19937& random, std::size_t longest) {
    std::uniform_real_distribution<double> u(0, 1);
    TPlaceString place;
    for (std::size_t n = random() % (longest + 1); n > 0; --n) {
        const char letter = "WCcJOX"[random() % 6];
        if (letter == 'W' || letter == 'O')
            place.push_back({letter, 4 * u(random), 0.05 + u(random)});
        else
            place.push_back({letter, letter == 'J' ? (random() % 2 == 0 ? 1.0 : -1.0) : 0, 0});
    }
    return place;
}

TEST(CPlaceDistance, IsWhatItsDefinitionSays) {
    std::mt19937 random(1);
    for (const double share : {0.0, 0.25, 0.4}) {
        TPlaceDistanceOptions options;
        options.freeShare = share;
        const CPlaceDistance distance(options);
        for (int round = 0; round < 300; ++round) {
            const TPlaceString a = randomString(random, 14), b = randomString(random, 14);
            const double d = distance(a, b);
            EXPECT_NEAR(d, plainDistance(distance, a, b), 1e-12) << asText(a) << " | " << asText(b);
            EXPECT_NEAR(d, distance(b, a), 1e-12);
            EXPECT_EQ(distance(a, a), 0);
            EXPECT_TRUE(d >= 0 && d <= 1);
            // with a limit: the same, or told to be above it
            EXPECT_EQ(distance(a, b, 0.4), d <= 0.4 ? d : kInfinity);
        }
    }
}

TEST(CPlaceDistance, CountsInSigmas) {
    TPlaceDistanceOptions options;
    options.freeShare = 0;
    const CPlaceDistance distance(options);
    // one wall 0.5 m longer, sigmas 0.3 and 0.4: 1 sigma of 2 walls of 3 each and 2 corners of 3
    EXPECT_NEAR(distance(parsePlaceString("W2~0.3 c"), parsePlaceString("W2.5~0.4 c")), 1.0 / 12,
                1e-12);
    EXPECT_NEAR(distance(parsePlaceString("c"), parsePlaceString("C")), 1, 1e-12);
    EXPECT_NEAR(distance(parsePlaceString("J1"), parsePlaceString("J-1")), 1, 1e-12);
    EXPECT_NEAR(distance(parsePlaceString("c"), {}), 1, 1e-12);
    EXPECT_EQ(distance({}, {}), 0);
    EXPECT_NEAR(distance(parsePlaceString("c W0.5~0.1"), parsePlaceString("c")), 1.5 / 7.5, 1e-12);
}

TEST(CPlaceDistance, LetsTheEndsStickOut) {
    const CPlaceDistance distance;
    const TPlaceString whole = parsePlaceString("W2~1 c W3~0.1 J1 O0.9~0.1 W4~0.5 c W1~1 C");
    const TPlaceString without(whole.begin() + 2, whole.end());
    EXPECT_EQ(distance(whole, TPlaceString(whole.begin() + 1, whole.end())), 0);
    EXPECT_EQ(distance(whole, TPlaceString(whole.begin() + 2, whole.end() - 2)),
              2 * 3.0 / (27 + 15));
    TPlaceString holed = whole;
    holed.erase(holed.begin() + 4);
    EXPECT_GT(distance(whole, holed), 0.05);  // inside nothing is free
}

}  // namespace
}  // namespace salma::laser
