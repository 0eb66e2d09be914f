// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <salma/slam/CSalientEKF2D.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "CTestWorld.h"

namespace salma::slam {
namespace {

TEkfOptions immediateCorners(EUpdate update = EUpdate::block) {
    TEkfOptions options;
    options.update = update;
    options.minSightingsCorner = 1;
    return options;
}

TStepInput step(double time, double forward, std::vector<Eigen::Vector2d> seen = {}) {
    TStepInput input;
    input.time = time;
    input.increment.mean = {forward, 0, 0};
    input.increment.cov = mrpt::math::CMatrixDouble33::Identity();
    input.increment.cov *= 1e-4;
    for (const Eigen::Vector2d& z : seen) {
        association::TMeasurement measurement;
        measurement.z = z;
        measurement.R = Eigen::Vector2d(1e-4, 1e-4).asDiagonal();
        input.measurements.push_back(measurement);
    }
    return input;
}

/// Squared Mahalanobis distance of the estimated pose from the true one.
double nees(const CSalientEKF2D& filter, const Eigen::Vector3d& truth) {
    const auto estimate = filter.pose();
    Eigen::Vector3d error(estimate.mean.x() - truth[0], estimate.mean.y() - truth[1],
                          mrpt::math::wrapToPi(estimate.mean.phi() - truth[2]));
    return error.dot(Eigen::Matrix3d(estimate.cov.asEigen()).llt().solve(error));
}

class CSalientEKF2DTest : public ::testing::TestWithParam<EUpdate> {};

TEST_P(CSalientEKF2DTest, CountsOdometryFromTheFirstStep) {
    CSalientEKF2D filter(immediateCorners(GetParam()), {});
    for (int i = 0; i < 3; ++i) filter.process(step(i, 1));
    EXPECT_NEAR(filter.pose().mean.x(), 3, 1e-12);
    // Heading variance before a step times its length, squared, adds to the lateral variance.
    EXPECT_NEAR(filter.pose().cov(0, 0), 3e-4, 1e-12);
    EXPECT_NEAR(filter.pose().cov(1, 1), 3e-4 + 1e-4 * (1 + 4), 1e-12);
    EXPECT_NEAR(filter.pose().cov(2, 2), 3e-4, 1e-12);
}

TEST_P(CSalientEKF2DTest, EstimatesPoseAndMapOfAWorldWithKnownLandmarks) {
    test::CTestWorld world(6);
    CSalientEKF2D filter(immediateCorners(GetParam()), {});
    for (int i = 0; i < 90; ++i) filter.process(world.next());
    TRunRecord record;
    filter.results(record);
    EXPECT_LT(
        (Eigen::Vector2d(filter.pose().mean.x(), filter.pose().mean.y()) - world.pose().head<2>())
            .norm(),
        0.15);
    ASSERT_GE(record.landmarks.size(), 25u);
    for (const TMapLandmark& landmark : record.landmarks) {
        const Eigen::Vector2d error = Eigen::Vector2d(landmark.mean.x, landmark.mean.y) -
                                      world.landmarks()[static_cast<std::size_t>(landmark.id)];
        EXPECT_LT(error.dot(landmark.covariance.llt().solve(error)), 18.4);  // 99.99 %
    }
    const RowMatrix P = filter.internal_getPkk().asEigen();
    EXPECT_TRUE(P.isApprox(P.transpose(), 1e-9));
    EXPECT_EQ(P.llt().info(), Eigen::Success);
}

TEST_P(CSalientEKF2DTest, MixesKnownAndUnknownLandmarks) {
    CSalientEKF2D filter(immediateCorners(GetParam()), {});
    for (int i = 0; i < 5; ++i) {
        TStepInput input = step(i, 0, {{3, 0.5}, {2, -1}, {4, 1.5}});
        input.measurements[0].identity = 10;
        input.measurements[2].identity = 11;
        filter.process(input);
    }
    ASSERT_EQ(filter.landmarks().size(), 3u);
    EXPECT_EQ(filter.landmarks()[0].id, 10);
    EXPECT_EQ(filter.landmarks()[1].id, 11);  // number above all ids so far
    EXPECT_EQ(filter.landmarks()[2].id, 12);  // 11 is in use; the identity stays
    EXPECT_EQ(filter.landmarks()[2].identity, 11);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(filter.landmarks()[i].sightings, 5u);
}

TEST_P(CSalientEKF2DTest, LeavesStateAndViewsToMrpt) {
    CSalientEKF2D filter(immediateCorners(GetParam()), {});
    filter.process(step(0, 0, {{3, 0.5}, {2, -1}}));
    mrpt::poses::CPosePDFGaussian pose;
    std::vector<mrpt::math::TPoint2D> points;
    std::map<unsigned, mrpt::maps::CLandmark::TLandmarkID> ids;
    mrpt::math::CVectorDouble state;
    mrpt::math::CMatrixDouble covariance;
    filter.getCurrentState(pose, points, ids, state, covariance);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_NEAR(points[0].x, 3 * std::cos(0.5), 1e-9);
    EXPECT_EQ(ids.size(), 2u);
    EXPECT_EQ(state.size(), 7);
    auto scene = mrpt::opengl::CSetOfObjects::Create();
    filter.getAs3DObject(scene);
    EXPECT_EQ(scene->size(), 4u);  // corner of the frame, robot, two landmarks
}

TEST_P(CSalientEKF2DTest, NeverLetsClutterIntoTheState) {
    CSalientEKF2D filter(immediateCorners(GetParam()), {});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    filter.process(step(0, 0, {{3, 0.5}, {nan, 0}, {2, nan}}));
    filter.process(step(1, 0.1, {{nan, nan}}));
    EXPECT_EQ(filter.landmarks().size(), 1u);
    EXPECT_TRUE(filter.internal_getPkk().asEigen().allFinite());
    EXPECT_TRUE(filter.internal_getXkk().asEigen().allFinite());
}

INSTANTIATE_TEST_SUITE_P(Updates,
                         CSalientEKF2DTest,
                         ::testing::Values(EUpdate::block, EUpdate::mrpt),
                         [](const ::testing::TestParamInfo<EUpdate>& update) {
                             return update.param == EUpdate::block ? "block" : "mrpt";
                         });

TEST(CSalientEKF2D, DoesWithItsOwnStepWhatMrptDoesWhereAllMeasurementsHaveOneCovariance) {
    test::CTestWorld world(7);
    CSalientEKF2D own(immediateCorners(EUpdate::block), {});
    CSalientEKF2D stock(immediateCorners(EUpdate::mrpt), {});
    for (int i = 0; i < 40; ++i) {
        const TStepInput input = world.next();
        own.process(input);
        stock.process(input);
    }
    EXPECT_TRUE(own.internal_getXkk().asEigen().isApprox(stock.internal_getXkk().asEigen(), 1e-8));
    EXPECT_TRUE(own.internal_getPkk().asEigen().isApprox(stock.internal_getPkk().asEigen(), 1e-6));
}

/// Vehicle-pose NEES over runs of Monte Carlo: share of steps whose mean lies in its 95 % interval.
double shareOfConsistentSteps(bool ignoreIdentities, std::size_t& wrongMaps) {
    const int runs = 30;
    const int steps = 100;
    std::vector<double> sums(steps, 0);
    wrongMaps = 0;
    for (int run = 0; run < runs; ++run) {
        test::CTestWorld world(100 + static_cast<std::uint32_t>(run));
        TEkfOptions options = immediateCorners();
        options.ignoreIdentities = ignoreIdentities;
        CSalientEKF2D filter(options, {});
        for (double& sum : sums) {
            filter.process(world.next());
            sum += nees(filter, world.pose());
        }
        wrongMaps += filter.landmarks().size() > world.landmarks().size();
    }
    int inside = 0;
    for (double sum : sums) inside += sum >= 65.65 && sum <= 118.14;  // chi2 of 90, 2.5 .. 97.5 %
    std::cout << inside << " of " << steps << " steps inside the interval" << std::endl;
    return static_cast<double>(inside) / steps;
}

TEST(CSalientEKF2D, IsConsistentWithKnownLandmarks) {
    std::size_t wrongMaps = 0;
    EXPECT_GE(shareOfConsistentSteps(false, wrongMaps), 0.85);
    EXPECT_EQ(wrongMaps, 0u);
}

TEST(CSalientEKF2D, IsConsistentWithUnknownLandmarks) {
    std::size_t wrongMaps = 0;
    EXPECT_GE(shareOfConsistentSteps(true, wrongMaps), 0.85);
    EXPECT_EQ(wrongMaps, 0u);
}

TEST(CSalientEKF2D, HoldsACornerBackUntilItIsSeenOftenEnough) {
    TEkfOptions options;
    options.minSightingsCorner = 3;
    CSalientEKF2D filter(options, {});
    filter.process(step(0, 0, {{3, 0.5}, {2, -1}}));  // the second is never seen again
    filter.process(step(1, 0, {{3, 0.5}}));
    EXPECT_EQ(filter.landmarks().size(), 0u);
    filter.process(step(2, 0, {{3, 0.5}}));
    EXPECT_EQ(filter.landmarks().size(), 1u);
    filter.process(step(3, 0, {{3, 0.5}}));
    TRunRecord record;
    filter.results(record);
    std::vector<EDecision> decisions;
    for (const auto& row : record.associations) decisions.push_back(row.decision);
    using E = EDecision;
    EXPECT_EQ(decisions, (std::vector<E>{E::provisional, E::provisional, E::provisional, E::created,
                                         E::paired}));
    EXPECT_EQ(record.landmarks[0].sightings, 2u);
    EXPECT_EQ(record.landmarks[0].firstTime, 2);
    EXPECT_EQ(record.landmarks[0].lastTime, 3);
}

TEST(CSalientEKF2D, UsesAPosterAtOnceAndTellsItWhenItIsConfirmed) {
    landmarks::TTrackingOptions tracking;  // two places, 5 deg apart
    CSalientEKF2D filter({}, {}, nullptr, tracking);
    const auto seen = [](double time, double forward, const Eigen::Vector2d& z) {
        TStepInput input = step(time, forward, {z});
        input.measurements[0].kind = association::ELandmarkKind::salient;
        input.measurements[0].wallAngle = -M_PI_2 - (z[1] > 0.7 ? 1e-3 : 0);
        input.measurements[0].wallAngleSigma = 0.02;
        return input;
    };
    const auto told = [&filter] {
        TRunRecord record;
        filter.results(record);
        return std::make_pair(record.associations.back().decision, record.landmarks.size());
    };
    // 2 m to the left of the path, 2 m ahead, then 1 m ahead, then beside the robot.
    filter.process(seen(0, 0, {std::sqrt(8.0), M_PI_4}));
    EXPECT_EQ(filter.landmarks().size(), 1u);
    EXPECT_EQ(told(), std::make_pair(EDecision::provisional, std::size_t(0)));
    filter.process(seen(1, 1, {std::sqrt(5.0), std::atan2(2, 1)}));
    EXPECT_EQ(filter.landmarks().size(), 1u);
    EXPECT_EQ(told(), std::make_pair(EDecision::created, std::size_t(1)));
    filter.process(seen(2, 1, {2, M_PI_2}));
    EXPECT_EQ(told(), std::make_pair(EDecision::paired, std::size_t(1)));
}

TEST(CSalientEKF2D, LeavesACornerToRelocationOnceItWasLeftBehind) {
    // A corner is seen, and again after some travel, when its place is unsure by 0.2 m.
    const auto seenAgain = [](double travel, bool hasPoster) {
        CSalientEKF2D filter(immediateCorners(), {});
        TStepInput first = step(0, 0, {{20, 0}});
        if (hasPoster) {
            auto poster = step(0, 0, {{3, 1}}).measurements[0];
            poster.kind = association::ELandmarkKind::salient;
            poster.patch = std::make_shared<observations::TPatch>();
            first.measurements.push_back(poster);
            first.spots.resize(2);
        }
        filter.process(first);
        TStepInput second = step(1, travel);
        second.increment.cov(0, 0) = 0.04;
        filter.process(second);
        filter.process(step(2, 0, {{20 - travel, 0}}));
        TRunRecord record;
        filter.results(record);
        return record.associations.back().decision;
    };
    EXPECT_EQ(seenAgain(10, true), EDecision::created);
    EXPECT_EQ(seenAgain(5, true), EDecision::paired) << "it was just used";
    EXPECT_EQ(seenAgain(10, false), EDecision::paired) << "nothing could tell it from others";
}

TEST(CSalientEKF2D, EndsWithThePathThatAllMeasurementsMake) {
    for (const bool smooth : {true, false}) {
        TEkfOptions options = immediateCorners();
        options.smooth = smooth;
        CSalientEKF2D filter(options, {});
        filter.process(step(0, 0, {{5, 0}}));
        filter.process(step(1, 1));               // wheels say 1 m; nothing is seen,
        filter.process(step(2, 1, {{2.96, 0}}));  // and then that it was 2.04 m in all
        filter.finish();
        TRunRecord record;
        filter.results(record);
        EXPECT_EQ(record.smoothed, smooth);
        EXPECT_EQ(record.trajectory[1].running.x(), 1);
        EXPECT_EQ(record.trajectory[1].pose.x() > 1.005, smooth);
        EXPECT_NEAR(record.trajectory[2].pose.x(), record.trajectory[2].running.x(), 1e-3);
    }
}

TEST(CSalientEKF2D, RecordsWhatItDid) {
    CSalientEKF2D filter(immediateCorners(), {});
    TStepInput input = step(5, 0, {{3, 0.5}});
    input.spots.resize(1);
    input.spots[0].pixel = {10, 20};
    input.spots[0].axisAngle = 0.25;
    filter.process(input);
    filter.process(step(6, 0, {{3.01, 0.5}}));
    filter.process(step(7, 0));
    TRunRecord record;
    filter.results(record);
    ASSERT_EQ(record.trajectory.size(), 3u);
    EXPECT_EQ(record.trajectory[0].sight, ESight::first);
    EXPECT_EQ(record.trajectory[1].sight, ESight::again);
    EXPECT_EQ(record.trajectory[2].sight, ESight::nothing);
    ASSERT_EQ(record.associations.size(), 2u);
    EXPECT_EQ(record.associations[0].u, 10);
    EXPECT_EQ(record.associations[0].axisAngle, 0.25);
    EXPECT_EQ(record.associations[0].landmark, 0);
    EXPECT_TRUE(std::isnan(record.associations[0].distance2));
    EXPECT_TRUE(std::isnan(record.associations[1].v));
    EXPECT_EQ(record.associations[1].landmark, 0);
    ASSERT_EQ(record.candidates.size(), 1u);
    EXPECT_TRUE(record.candidates[0].chosen);
    ASSERT_EQ(record.innovations.size(), 2u);
    EXPECT_EQ(record.innovations[0].component, "range_m");
    EXPECT_NEAR(record.innovations[0].value, 0.01, 1e-9);
    // R twice (landmark and measurement) and the position noise of the second step.
    EXPECT_NEAR(record.innovations[0].sigma, std::sqrt(3e-4), 1e-9);
    EXPECT_EQ(record.innovations[1].component, "bearing_deg");
}

TEST(CSalientEKF2D, TellsPostersApartByTheirAppearance) {
    const auto patch = [](double width) {
        auto made = std::make_shared<observations::TPatch>();
        made->width = width;
        return made;
    };
    const PatchRatio sameWidth = [](const observations::TPatch& a, const observations::TPatch& b) {
        return a.width == b.width ? 4.0 : -4.0;
    };
    CSalientEKF2D filter({}, {}, sameWidth);
    TStepInput input = step(0, 0, {{3, 0.5}});
    input.measurements[0].kind = association::ELandmarkKind::salient;
    input.measurements[0].patch = patch(1);
    filter.process(input);
    filter.process(input);
    EXPECT_EQ(filter.landmarks().size(), 1u);
    input.measurements[0].patch = patch(2);  // another poster in the same place
    filter.process(input);
    EXPECT_EQ(filter.landmarks().size(), 2u);
    EXPECT_EQ(filter.dropped().appearance, 1u);
}

TEST(CSalientEKF2D, RefusesAStepThatIsNotSound) {
    CSalientEKF2D filter(immediateCorners(), {});
    TStepInput input = step(0, std::numeric_limits<double>::infinity());
    EXPECT_THROW(filter.process(input), std::invalid_argument);
    input = step(0, 0, {{3, 0.5}});
    input.spots.resize(2);
    EXPECT_THROW(filter.process(input), std::invalid_argument);
}

/// Two posters 1 m apart on the wall ahead, then a robot that has slid sideways, nobody knows how
/// far, and sees one poster just between them. Beams end early from `from` to `to` [deg]; posters
/// in view are found with a probability.
EDecision decisionBetweenTwoPosters(double from, double to, double found, int& landmark) {
    const auto poster = [](double bearing) {
        association::TMeasurement m;
        m.kind = association::ELandmarkKind::salient;
        m.z = {std::hypot(3, 3 * std::tan(bearing)), bearing};
        m.R = Eigen::Vector2d(1e-4, 1e-4).asDiagonal();
        m.wallAngle = M_PI;
        m.wallAngleSigma = 0.02;
        return m;
    };
    const double side = std::atan2(0.5, 3);
    association::TAssociationOptions association;
    association.margin = 1;
    TMapCare care;
    care.detection.incidence = care.detection.range = {0};
    care.detection.byIncidence = {found};
    care.detection.byRange = {1};
    CSalientEKF2D filter(immediateCorners(), association, nullptr, CSalientEKF2D::atFirstSight(),
                         care);
    TStepInput input = step(0, 0);
    input.camera = TCameraView{{0, 0, 0}, 0.8};
    input.measurements = {poster(side), poster(-side)};
    filter.process(input);
    input = step(1, 0);
    input.increment.cov(1, 1) = 0.4 * 0.4;
    input.camera = TCameraView{{0, 0, 0}, 0.8};
    input.measurements = {poster(0)};
    input.laser.emplace();
    input.laser->first = -M_PI / 2;
    input.laser->spacing = M_PI / 180;
    auto free = std::make_shared<std::vector<float>>(181, 8.0F);
    for (int i = 0; i <= 180; ++i)
        if (i - 90 >= from && i - 90 <= to) (*free)[static_cast<std::size_t>(i)] = 1;
    input.laser->free = free;
    filter.process(input);
    TRunRecord record;
    filter.results(record);
    landmark = record.associations.back().landmark;
    return record.associations.back().decision;
}

TEST(CSalientEKF2D, PairsTheOneOfTwoPostersThatNothingHides) {
    int landmark = -1;
    EXPECT_EQ(decisionBetweenTwoPosters(0, -1, 0.95, landmark), EDecision::deferred);
    EXPECT_EQ(decisionBetweenTwoPosters(-1, 40, 0.95, landmark), EDecision::paired);
    EXPECT_EQ(landmark, 1) << "which should be seen, and would be missing";
    EXPECT_EQ(decisionBetweenTwoPosters(-40, 1, 0.95, landmark), EDecision::paired);
    EXPECT_EQ(landmark, 0);
    // Where both are hidden neither would be missing, nor where posters are mostly overlooked.
    EXPECT_EQ(decisionBetweenTwoPosters(-40, 40, 0.95, landmark), EDecision::deferred);
    EXPECT_EQ(decisionBetweenTwoPosters(-1, 40, 0.2, landmark), EDecision::deferred);
}

}  // namespace
}  // namespace salma::slam
