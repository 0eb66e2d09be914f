// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/laser/CPlaceClassifier.h>
#include <salma/laser/CPlaceFilter.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "segmentWorld.h"

namespace salma::laser {
namespace {

using mrpt::poses::CPose2D;
using test::TScanner;

mrpt::obs::CObservation2DRangeScan scanOf(const std::vector<mrpt::math::TPoint2D>& outline,
                                          const CPose2D& pose,
                                          std::size_t beams = 181) {
    std::mt19937 random(1);
    TScanner scanner;
    scanner.beams = beams;
    scanner.sigma = 0.005;
    scanner.quantum = 0.001;
    return test::castScan(test::polygon(outline), pose, scanner, random);
}

EPlaceClass placeOf(const mrpt::obs::CObservation2DRangeScan& scan) {
    const auto p = CPlaceClassifier().classify(scan);
    return p ? mostLikely(*p) : throw std::runtime_error("not judged");
}

/// A corridor along x, 2 m wide, the robot at its axis looking along x; then what follows.
std::vector<mrpt::math::TPoint2D> straight() { return {{-9, -1}, {12, -1}, {12, 1}, {-9, 1}}; }
std::vector<mrpt::math::TPoint2D> closed() { return {{-9, -1}, {2, -1}, {2, 1}, {-9, 1}}; }
std::vector<mrpt::math::TPoint2D> bendLeft() {
    return {{-9, -1}, {3, -1}, {3, 10}, {1.2, 10}, {1.2, 1}, {-9, 1}};
}
std::vector<mrpt::math::TPoint2D> teeLeft() {
    return {{-9, -1}, {12, -1}, {12, 1}, {3, 1}, {3, 10}, {1.2, 10}, {1.2, 1}, {-9, 1}};
}
std::vector<mrpt::math::TPoint2D> teeAhead() {
    return {{-9, -1}, {1.2, -1}, {1.2, -10}, {3, -10}, {3, 10}, {1.2, 10}, {1.2, 1}, {-9, 1}};
}
std::vector<mrpt::math::TPoint2D> room() { return {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}; }

std::vector<mrpt::math::TPoint2D> mirror(std::vector<mrpt::math::TPoint2D> outline) {
    for (auto& p : outline) p.y = -p.y;
    return outline;
}

TEST(CPlaceClassifier, TellsTheTenClassesApartInPlainWorlds) {
    const CPose2D ahead(0, 0, 0.1);
    EXPECT_EQ(placeOf(scanOf(straight(), ahead)), EPlaceClass::corridor);
    EXPECT_EQ(placeOf(scanOf(closed(), ahead)), EPlaceClass::deadEnd);
    EXPECT_EQ(placeOf(scanOf(bendLeft(), ahead)), EPlaceClass::bendLeft);
    EXPECT_EQ(placeOf(scanOf(mirror(bendLeft()), ahead)), EPlaceClass::bendRight);
    EXPECT_EQ(placeOf(scanOf(teeLeft(), ahead)), EPlaceClass::teeLeft);
    EXPECT_EQ(placeOf(scanOf(mirror(teeLeft()), ahead)), EPlaceClass::teeRight);
    EXPECT_EQ(placeOf(scanOf(teeAhead(), ahead)), EPlaceClass::teeAhead);
    EXPECT_EQ(placeOf(scanOf(room(), {2.5, 2.8, 0.1})), EPlaceClass::cornerLeft);
    EXPECT_EQ(placeOf(scanOf(room(), {2.5, -2.8, 0.1})), EPlaceClass::cornerRight);
    EXPECT_EQ(placeOf(scanOf(room(), {-1, 0.3, 0.1})), EPlaceClass::open);
}

TEST(CPlaceClassifier, JudgesTheMirrorImageAsTheMirroredClass) {
    const CPlaceClassifier classifier;
    const auto seen = classifier.classify(scanOf(teeLeft(), {0.3, 0.2, 0.15}));
    const auto found = CPlaceClassifier::features(scanOf(teeLeft(), {0.3, 0.2, 0.15}));
    ASSERT_TRUE(seen && found);
    const TPlaceVector other = classifier.classify(TPlaceFeatures{found->mirrored, found->asSeen});
    for (std::size_t i = 0; i < kPlaceClasses; ++i) {
        const auto twin = static_cast<std::size_t>(mirrored(static_cast<EPlaceClass>(i)));
        EXPECT_NEAR((*seen)[i], other[twin], 1e-6);
    }
    EXPECT_NEAR(std::accumulate(seen->begin(), seen->end(), 0.0), 1, 1e-12);
}

TEST(CPlaceClassifier, TakesTheSameScanInAnyOrderAndResolution) {
    auto scan = scanOf(bendLeft(), {0, 0, 0.1}, 361);
    EXPECT_EQ(placeOf(scan), EPlaceClass::bendLeft);
    auto reversed = scan;
    reversed.rightToLeft = false;
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
        const std::size_t k = scan.getScanSize() - 1 - i;
        reversed.setScanRange(i, scan.getScanRange(k));
        reversed.setScanRangeValidity(i, scan.getScanRangeValidity(k));
    }
    EXPECT_EQ(CPlaceClassifier().classify(scan), CPlaceClassifier().classify(reversed));
    reversed.rightToLeft = true;  // the readings now say the opposite
    EXPECT_EQ(placeOf(reversed), EPlaceClass::bendRight);
}

TEST(CPlaceClassifier, DoesNotJudgeWhatSaysTooLittle) {
    const CPlaceClassifier classifier;
    const auto good = scanOf(closed(), {0, 0, 0});
    const auto edited = [&](auto edit) {
        auto scan = good;
        edit(scan);
        return classifier.classify(scan).has_value();
    };
    EXPECT_TRUE(edited([](auto&) {}));
    EXPECT_FALSE(edited([](auto& s) { s.resizeScan(0); }));
    EXPECT_FALSE(edited([](auto& s) { s.resizeScan(1); }));
    EXPECT_FALSE(edited([](auto& s) { s.aperture = 1.5F; }));
    EXPECT_FALSE(edited([](auto& s) { s.aperture = std::numeric_limits<float>::quiet_NaN(); }));
    EXPECT_FALSE(edited([](auto& s) { s.sensorPose.setYawPitchRoll(0, 0.5, 0); }));
    for (const float value : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity()})
        EXPECT_FALSE(edited([&](auto& s) {
            for (std::size_t i = 0; i < s.getScanSize(); ++i) s.setScanRange(i, value);
        })) << value;
    EXPECT_FALSE(edited([](auto& s) {
        for (std::size_t i = 0; i < s.getScanSize(); ++i) s.setScanRangeValidity(i, i % 5 == 0);
    }));
}

TEST(CPlaceClassifier, SurvivesScansThatMeanNothing) {
    const CPlaceClassifier classifier;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(-2, 12);
    auto scan = scanOf(closed(), {0, 0, 0});
    for (int round = 0; round < 200; ++round) {
        scan.resizeScan(2 + random() % 400);
        for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
            const float r = round == 0 ? 2.0F : any(random);  // once constant
            scan.setScanRange(i, random() % 9 == 0 ? std::nanf("") : r);
            scan.setScanRangeValidity(i, random() % 7 != 0);
        }
        scan.aperture = static_cast<float>(M_PI) * static_cast<float>(1 + round % 3);
        const auto p = classifier.classify(scan);
        if (!p) continue;
        for (const double value : *p) EXPECT_TRUE(value >= 0 && value <= 1);
    }
}

TEST(CPlaceClassifier, RefusesANetworkThatDoesNotFit) {
    TPlaceNetwork network = shippedPlaceNetwork();
    EXPECT_NO_THROW(network.validate());
    network.layers[0](0, 0) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(CPlaceClassifier{network}, std::invalid_argument);
    network = shippedPlaceNetwork();
    network.layers.pop_back();
    EXPECT_THROW(CPlaceClassifier{network}, std::invalid_argument);
    EXPECT_THROW(CPlaceClassifier{TPlaceNetwork{}}, std::invalid_argument);
}

TEST(EPlaceClass, NamesAndMirrorImagesAreTheirOwnInverse) {
    for (std::size_t i = 0; i < kPlaceClasses; ++i) {
        const auto place = static_cast<EPlaceClass>(i);
        EXPECT_EQ(placeClassOf(asString(place)), place);
        EXPECT_EQ(mirrored(mirrored(place)), place);
    }
    EXPECT_FALSE(placeClassOf("kitchen"));
}

TPlaceVector mostly(EPlaceClass place, double share) {
    TPlaceVector p;
    p.fill((1 - share) / (kPlaceClasses - 1));
    p[static_cast<std::size_t>(place)] = share;
    return p;
}

TEST(CPlaceFilter, FollowsBayesRule) {
    TPlaceTransitions transitions;
    for (auto* matrix : {&transitions.goingOn, &transitions.turning})
        for (std::size_t i = 0; i < kPlaceClasses; ++i)
            for (std::size_t j = 0; j < kPlaceClasses; ++j) (*matrix)[i][j] = i == j ? 0.91 : 0.01;
    TPlaceFilterOptions options;
    options.surprise = 0;
    CPlaceFilter filter(options, transitions);
    const TPlaceVector scan = mostly(EPlaceClass::corridor, 0.55);  // the others 0.05
    EXPECT_NEAR(filter.update(scan)[0], 0.55, 1e-4);
    // predicted: 0.55 * 0.91 + 0.45 * 0.01 = 0.505; each other 0.055
    const double right = 0.505 * 0.55, wrong = 9 * 0.055 * 0.05;
    EXPECT_NEAR(filter.update(scan)[0], right / (right + wrong), 1e-4);
}

TEST(CPlaceFilter, PassesOverASingleWrongScanButFollowsALastingChange) {
    CPlaceFilter filter;
    for (int i = 0; i < 10; ++i) filter.update(mostly(EPlaceClass::corridor, 0.9));
    filter.update(mostly(EPlaceClass::deadEnd, 0.6));
    EXPECT_EQ(mostLikely(filter.belief()), EPlaceClass::corridor);
    for (int i = 0; i < 6; ++i) filter.update(mostly(EPlaceClass::teeLeft, 0.9));
    EXPECT_EQ(mostLikely(filter.belief()), EPlaceClass::teeLeft);
    filter.skip(EPlaceStep::turning);
    EXPECT_NEAR(std::accumulate(filter.belief().begin(), filter.belief().end(), 0.0), 1, 1e-4);
}

TEST(CPlaceFilter, RefusesWhatIsNoDistribution) {
    CPlaceFilter filter;
    EXPECT_THROW(filter.update(TPlaceVector{}), std::invalid_argument);
    TPlaceVector scan = mostly(EPlaceClass::open, 0.5);
    scan[3] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(filter.update(scan), std::invalid_argument);
    scan[3] = -0.1;
    EXPECT_THROW(filter.update(scan), std::invalid_argument);
    TPlaceTransitions transitions = shippedPlaceTransitions();
    transitions.turning[2][2] += 0.5;
    EXPECT_THROW(CPlaceFilter({}, transitions), std::invalid_argument);
    TPlaceFilterOptions options;
    options.evidence = 0;
    EXPECT_THROW(CPlaceFilter{options}, std::invalid_argument);
}

}  // namespace
}  // namespace salma::laser
