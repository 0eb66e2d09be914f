// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/laser/CPlaceClassifier.h>
#include <salma/laser/CRevisitModel.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

namespace salma::laser {
namespace {

constexpr EPlaceClass kCorridor = EPlaceClass::corridor, kTee = EPlaceClass::teeLeft,
                      kBend = EPlaceClass::bendRight, kOpen = EPlaceClass::open;

TPlaceVector mostly(EPlaceClass place, double share) {
    TPlaceVector p;
    p.fill((1 - share) / (kPlaceClasses - 1));
    p[static_cast<std::size_t>(place)] = share;
    return p;
}

TPlaceMatrix vague() {
    TPlaceMatrix prior;
    for (auto& row : prior) row.fill(0.5);
    return prior;
}

/// A ring of corridor, T, corridor, bend; one may leave at the T and come back after it.
std::vector<TMapPlace> ring() {
    std::vector<TMapPlace> map;
    for (const EPlaceClass place : {kCorridor, kTee, kCorridor, kBend})
        map.push_back({mostly(place, 0.91), {(map.size() + 1) % 4}, false, false});
    map[1].exit = true;
    map[2].entry = true;
    return map;
}

TEST(CRevisitModel, WeighsTheFirstScanByHand) {
    TRevisitOptions options;
    options.evidence = 1;
    options.outsideAtStart = 0.4;
    CRevisitModel model(options, vague(), ring());
    // inside: half corridor, a quarter T and bend each; a scan that says T with 0.55
    const TPlaceVector scan = mostly(kTee, 0.55);  // the others 0.05
    const double isTee = 0.91 * 0.55 + 0.09 * 0.05, isOther = 0.01 * 0.55 + 0.99 * 0.05;
    const double in = 0.6 * (0.25 * isTee + 0.75 * isOther), out = 0.4 * 0.1;
    EXPECT_NEAR(model.update(scan), out / (in + out), 1e-4);
    double all = model.outside();
    for (const double p : model.inside()) all += p;
    EXPECT_NEAR(all, 1, 1e-12);
}

TEST(CRevisitModel, KnowsItsMapAgain) {
    CRevisitModel model({}, vague(), ring());
    for (int lap = 0; lap < 3; ++lap)
        for (const EPlaceClass place : {kCorridor, kTee, kCorridor, kBend})
            model.update(mostly(place, 0.9));
    EXPECT_LT(model.outside(), 0.1);
    EXPECT_GT(model.inside()[3], 0.8);  // at the bend
}

TEST(CRevisitModel, NoticesThatItHasLeftAndThatItIsBack) {
    CRevisitModel model({}, vague(), ring());
    for (const EPlaceClass place : {kCorridor, kTee, kCorridor, kBend, kCorridor, kTee})
        model.update(mostly(place, 0.9));
    EXPECT_LT(model.outside(), 0.2);
    for (int i = 0; i < 10; ++i) model.update(mostly(kOpen, 0.9));  // no such place in the map
    EXPECT_GT(model.outside(), 0.95);
    for (int lap = 0; lap < 4; ++lap)
        for (const EPlaceClass place : {kCorridor, kBend, kCorridor, kTee})
            model.update(mostly(place, 0.9));
    EXPECT_LT(model.outside(), 0.3);
}

TEST(CRevisitModel, ExpectsLessOfAMapWhoseClassesAreEverywhere) {
    // the same walk along corridors: no evidence where buildings consist of corridors
    TPlaceMatrix corridors = vague();
    for (auto& row : corridors) row[static_cast<std::size_t>(kCorridor)] = 200;
    const std::vector<TMapPlace> map{{mostly(kCorridor, 0.91), {1}, true, true},
                                     {mostly(kCorridor, 0.91), {0}, true, true}};
    CRevisitModel alike({}, corridors, map), varied({}, vague(), map);
    for (int i = 0; i < 5; ++i) {
        alike.update(mostly(kCorridor, 0.9));
        varied.update(mostly(kCorridor, 0.9));
    }
    EXPECT_GT(alike.outside(), varied.outside() + 0.05);
}

TEST(CRevisitModel, LearnsHowTheBuildingGoesOnOutside) {
    CRevisitModel model({}, vague(), ring());
    const auto from = static_cast<std::size_t>(kOpen);
    const double before = model.structure()[from][from];
    for (int i = 0; i < 30; ++i) model.update(mostly(kOpen, 0.97));
    EXPECT_GT(model.structure()[from][from], before + 0.3);
    for (const auto& row : model.structure())
        EXPECT_NEAR(std::accumulate(row.begin(), row.end(), 0.0), 1, 1e-12);
}

TEST(fitPlacePrior, FindsTheDensityThatBuildingsWereDrawnFrom) {
    // each building draws its own transitions from Dirichlet(8, 4, 2, ...) and then 400 steps
    const std::vector<double> alpha{8, 4, 2, 1, 1, 1, 0.5, 0.5, 0.5, 0.5};
    std::mt19937 random(1);
    std::vector<TPlaceMatrix> buildings;
    for (int b = 0; b < 200; ++b) {
        TPlaceMatrix counts{};
        std::vector<double> p;
        for (const double a : alpha) p.push_back(std::gamma_distribution<double>(a, 1)(random));
        std::discrete_distribution<std::size_t> next(p.begin(), p.end());
        for (int i = 0; i < 400; ++i) ++counts[2][next(random)];
        buildings.push_back(counts);
    }
    const TPlaceMatrix prior = fitPlacePrior(buildings);
    for (std::size_t i = 0; i < alpha.size(); ++i)
        EXPECT_NEAR(prior[2][i], alpha[i], 0.2 * alpha[i] + 0.1) << i;
    EXPECT_EQ(prior[0][0], 0.5);  // never seen
}

TEST(fitPlacePrior, StaysFiniteWhereBuildingsSayLittleOrAllTheSame) {
    for (const double count : {1.0, 5.0}) {
        TPlaceMatrix one{};
        one[0][1] = count;
        for (const auto& buildings : {std::vector<TPlaceMatrix>{one}, {one, one, one}}) {
            const TPlaceMatrix prior = fitPlacePrior(buildings);
            for (const auto& row : prior)
                for (const double value : row) EXPECT_TRUE(value > 0 && std::isfinite(value));
            EXPECT_NO_THROW(CRevisitModel({}, prior, ring()));
        }
    }
    EXPECT_EQ(fitPlacePrior({})[3][4], 0.5);
}

TEST(CRevisitModel, RefusesWhatMakesNoSense) {
    const auto refused = [](auto edit) {
        TRevisitOptions options;
        TPlaceMatrix prior = vague();
        std::vector<TMapPlace> map = ring();
        edit(options, prior, map);
        EXPECT_THROW(CRevisitModel(options, prior, map), std::invalid_argument);
    };
    refused([](auto& o, auto&, auto&) { o.enter = 1; });
    refused([](auto& o, auto&, auto&) { o.leave = std::nan(""); });
    refused([](auto&, auto& p, auto&) { p[1][2] = 0; });
    refused([](auto&, auto& p, auto&) { p[1][2] = std::numeric_limits<double>::infinity(); });
    refused([](auto&, auto&, auto& m) { m.clear(); });
    refused([](auto&, auto&, auto& m) { m[2].entry = false; });
    refused([](auto&, auto&, auto& m) { m[0].next = {4}; });
    refused([](auto&, auto&, auto& m) { m[0].classes[0] = 3; });
    refused([](auto&, auto&, auto& m) { m[0].classes[0] = std::nan(""); });
    CRevisitModel model({}, vague(), ring());
    EXPECT_THROW(model.update({}), std::invalid_argument);
    EXPECT_THROW(model.update(mostly(kOpen, std::nan(""))), std::invalid_argument);
    TPlaceMatrix negative{};
    negative[0][0] = -1;
    EXPECT_THROW(fitPlacePrior({negative}), std::invalid_argument);
}

}  // namespace
}  // namespace salma::laser
