// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/observations/readCarmenLog.h>

#include <sstream>

#include "CConfusion.h"
#include "CTemporaryFolder.h"
#include "TPlaceSample.h"
#include "revisitFigures.h"
#include "trainNetwork.h"
#include "writeModel.h"

namespace salma::bench {
namespace {

using laser::EPlaceClass;
using laser::mostLikely;

TEST(PlaceClassifier, IsRightInBuildingsThatItHasNotSeen) {
    const laser::CPlaceClassifier classifier;
    CConfusion confusion;
    for (std::uint32_t seed = 7001; seed <= 7012; ++seed)
        for (const auto& sample : drawSamples(testBuildings(), seed, 8)) {
            if (!sample.truth.place) continue;
            const auto p = classifier.classify(sample.scan);
            ASSERT_TRUE(p);
            confusion.add(seed, *sample.truth.place, mostLikely(*p));
        }
    EXPECT_GT(confusion.total(), 800u);
    EXPECT_GE(confusion.balancedAccuracy().value, 0.95);
}

TEST(trainNetwork, LearnsWhatCanBeLearntTheSameEachTime) {
    const auto rows = static_cast<Eigen::Index>(laser::CPlaceClassifier::numberOfFeatures());
    Eigen::MatrixXf features = Eigen::MatrixXf::Zero(rows, 1000);
    Eigen::MatrixXf targets = Eigen::MatrixXf::Zero(laser::kPlaceClasses, 1000);
    std::srand(1);  // Eigen's random numbers
    for (Eigen::Index i = 0; i < 1000; ++i) {
        const Eigen::Index place = i % static_cast<Eigen::Index>(laser::kPlaceClasses);
        features.col(i).setRandom();
        features(place, i) += 4;
        targets(place, i) = 1;
    }
    TTrainingOptions options;
    options.epochs = 40;
    std::ostringstream log;
    const auto network = trainNetwork(features, targets, options, log);
    const laser::CPlaceClassifier classifier(network);
    std::size_t right = 0;
    for (Eigen::Index i = 0; i < 1000; ++i) {
        const auto place = static_cast<EPlaceClass>(i % 10);
        Eigen::VectorXf mirror = features.col(i);
        mirror(i % 10) -= 4;
        mirror(static_cast<Eigen::Index>(mirrored(place))) += 4;
        right += mostLikely(classifier.classify({features.col(i), mirror})) == place ? 1 : 0;
    }
    EXPECT_GT(right, 950u);
    const auto again = trainNetwork(features, targets, options, log);
    EXPECT_EQ(network.layers.front(), again.layers.front());
}

TEST(writeModel, WritesTheShippedModelAsItIs) {
    std::ostringstream text;
    writeModel(laser::shippedPlaceNetwork(), laser::shippedPlaceTransitions(), text);
    EXPECT_NE(text.str().find("kPlaceLayers{97, 64, 32, 10}"), std::string::npos);
    EXPECT_EQ(text.str().find("nan"), std::string::npos);
    EXPECT_LT(text.str().size(), 80000u);
}

TEST(CRevisitModel, IsMostlyRightInHalfMappedBuildings) {
    const auto prior = priorOfBuildings(trainingBuildings(), 1, 10);
    std::size_t right = 0, all = 0;
    double brier = 0;
    for (std::uint32_t seed = 7101; seed <= 7104; ++seed)
        for (const TRevisitStep& s : walkHalfMapped(testBuildings(), seed, prior, {})) {
            right += (s.outside > 0.5) == s.truth ? 1 : 0;
            brier += (s.outside - s.truth) * (s.outside - s.truth);
            ++all;
        }
    EXPECT_EQ(all, 4u * 10u * 60u);
    EXPECT_GT(right, all * 3 / 4);
    EXPECT_LT(brier / static_cast<double>(all), 0.15);
}

TEST(PlaceClassifier, KnowsTheCorridorOfARealCastle) {
    SALMA_NEED_DATA(file, "laser/belgioioso-corrected.log.gz");
    const laser::CPlaceClassifier classifier;
    std::size_t corridor = 0, all = 0;
    for (const auto& scan : observations::readCarmenLog(file).scans) {
        const auto p = classifier.classify(*scan.scan);
        ASSERT_TRUE(p);
        // the plain part of the only corridor, seen along it
        if (!(scan.odometry.x() > 2 && scan.odometry.x() < 7 && scan.odometry.y() > 6 &&
              scan.odometry.y() < 24))
            continue;
        ++all;
        corridor += mostLikely(*p) == EPlaceClass::corridor ? 1 : 0;
    }
    EXPECT_GT(all, 10u);
    EXPECT_GE(corridor, all * 9 / 10);
}

TEST(CConfusion, WeighsTheClassesAlike) {
    CConfusion confusion;
    for (std::uint32_t building = 1; building <= 4; ++building) {
        for (int i = 0; i < 99; ++i)
            confusion.add(building, EPlaceClass::corridor, EPlaceClass::corridor);
        confusion.add(building, EPlaceClass::open,
                      building <= 2 ? EPlaceClass::open : EPlaceClass::corridor);
    }
    const auto accuracy = confusion.balancedAccuracy();
    EXPECT_NEAR(accuracy.value, 0.75, 1e-12);
    EXPECT_LT(accuracy.low, 0.75);
    EXPECT_GT(accuracy.high, 0.75);
    EXPECT_EQ(confusion.total(), 400u);
}

}  // namespace
}  // namespace salma::bench
