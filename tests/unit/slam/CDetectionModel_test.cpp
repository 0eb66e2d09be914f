// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/CDetectionModel.h>

#include <cmath>

namespace salma::slam {
namespace {

using association::ELandmarkKind;

constexpr double degree = M_PI / 180;

Eigen::Vector2d at(double range, double degrees) {
    return {range * std::cos(degrees * degree), range * std::sin(degrees * degree)};
}

/// A camera straight ahead with 40 deg to each side, and 181 beams of 8 m, but from 10 to 20 deg to
/// the left, where somebody stands at 1 m.
TViews views() {
    TViews result;
    result.camera = TCameraView{{0, 0, 0}, 40 * degree};
    result.scanned = true;
    result.laser.emplace();
    result.laser->first = -M_PI / 2;
    result.laser->spacing = degree;
    auto free = std::make_shared<std::vector<float>>(181, 8.0F);
    for (int i = 100; i <= 110; ++i) (*free)[i] = 1;
    result.laser->free = free;
    return result;
}

/// Found in 0.8 of all looks where incidence and range say nothing against it, corners in 0.6.
TDetectionOptions tables() {
    TDetectionOptions options;
    options.incidence = {0, 60, 90};
    options.byIncidence = {0.8, 0.8, 0};
    options.range = {0, 4, 8};
    options.byRange = {1, 1, 0.5};
    options.cornerRange = {0, 4, 8};
    options.byCornerRange = {0.6, 0.6, 0};
    return options;
}

/// Facing the robot unless `turned` [deg].
TBelievedPlace place(double range, double degrees, double turned = 0, double sigma = 0) {
    TBelievedPlace result;
    result.point = at(range, degrees);
    result.wallAngle = (degrees + 180 + turned) * degree;
    result.covariance = sigma * sigma * Eigen::Matrix2d::Identity();
    return result;
}

TEST(CDetectionModel, TakesTheTablesForAPosterThatIsInView) {
    const CDetectionModel model(tables());
    EXPECT_NEAR(model.poster(views(), place(3, 0)).probability(), 0.8, 1e-6);
    EXPECT_NEAR(model.poster(views(), place(6, 0)).probability(), 0.8 * 0.75, 1e-6);
    EXPECT_NEAR(model.poster(views(), place(3, -5, 75)).probability(), 0.4, 1e-6);
    EXPECT_NEAR(model.poster(views(), place(3, -5, -75)).probability(), 0.4, 1e-6);
    auto unknownWall = place(3, 0);
    unknownWall.wallAngle = std::nan("");
    EXPECT_NEAR(model.poster(views(), unknownWall).probability(), 0.8, 1e-6);
}

TEST(CDetectionModel, SeesNoPosterFromBehindOrOutsideTheConeOrBehindAnotherThing) {
    const CDetectionModel model(tables());
    EXPECT_EQ(model.poster(views(), place(3, 0, 180)).probability(), 0);
    EXPECT_EQ(model.poster(views(), place(3, 60)).probability(), 0);
    EXPECT_EQ(model.poster(views(), place(3, 180)).probability(), 0);
    EXPECT_EQ(model.poster(views(), place(3, 15)).probability(), 0);
    EXPECT_NEAR(model.poster(views(), place(0.9, 15)).probability(), 0.8,
                1e-6);                                               // before the person
    EXPECT_EQ(model.poster(views(), place(9, 0)).probability(), 0);  // behind the wall
    auto blind = views();
    blind.laser.reset();
    EXPECT_NEAR(model.poster(blind, place(3, 15)).probability(), 0.8, 1e-6);
}

TEST(CDetectionModel, NeedsAPictureForPostersAndAScanForCorners) {
    const CDetectionModel model(tables());
    auto scanOnly = views();
    scanOnly.camera.reset();
    EXPECT_EQ(model.poster(scanOnly, place(3, 0)).probability(), 0);
    EXPECT_NEAR(model.corner(scanOnly, place(3, 0)).probability(), 0.6, 1e-9);
    auto pictureOnly = views();
    pictureOnly.scanned = false;
    EXPECT_NEAR(model.poster(pictureOnly, place(3, 0)).probability(), 0.8, 1e-6);
    EXPECT_EQ(model.corner(pictureOnly, place(3, 0)).probability(), 0);
}

TEST(CDetectionModel, SeesCornersByRangeWithinTheFieldOfTheScanner) {
    const CDetectionModel model(tables());
    EXPECT_NEAR(model.corner(views(), place(3, 60)).probability(), 0.6, 1e-9);
    EXPECT_NEAR(model.corner(views(), place(6, 60)).probability(), 0.3, 1e-9);
    EXPECT_EQ(model.corner(views(), place(3, 15)).probability(), 0);
    EXPECT_EQ(model.corner(views(), place(3, 120)).probability(), 0);
    EXPECT_EQ(model.corner(views(), place(3, 180)).probability(), 0);
}

/* At the border of the field half of the belief lies inside. Inside and outside come nearer to each
 * other the less is known. */
TEST(CDetectionModel, BlursTheBordersByWhatIsNotKnown) {
    const CDetectionModel model(tables());
    EXPECT_NEAR(model.poster(views(), place(3, -37)).probability(), 0.4, 1e-3);
    EXPECT_NEAR(model.poster(views(), place(3, -37, 0, 0.3)).probability(), 0.4, 1e-3);
    EXPECT_GT(model.poster(views(), place(3, -30)).probability(), 0.79);
    EXPECT_LT(model.poster(views(), place(3, -44)).probability(), 0.01);
    const double inside = model.poster(views(), place(3, -30, 0, 0.4)).probability();
    const double outside = model.poster(views(), place(3, -44, 0, 0.4)).probability();
    EXPECT_NEAR(inside + outside, 0.8, 1e-3);
    // 7 deg are 0.89 sigma of 0.4 m across 3 m and the blur together: Phi(0.89) = 0.81.
    // less.
    EXPECT_NEAR(inside, 0.8 * 0.815, 0.01);
    // Just beyond the wall, as far as is known, may mean on it.
    EXPECT_EQ(model.poster(views(), place(8.7, 0)).probability(), 0);
    EXPECT_NEAR(model.poster(views(), place(8.7, 0, 0, 0.4)).probability(), 0.4, 1e-3);
    // Seen along its wall: it faces the robot or not.
    auto slanting = place(3, 0, 90);
    slanting.wallAngleSigma = 0.1;
    EXPECT_NEAR(CDetectionModel::posterInView(views(), slanting), 0.5, 1e-6);
    EXPECT_NEAR(CDetectionModel::cornerInView(views(), place(3, -90.5, 0, 0.2)), 0.5, 1e-3);
}

TEST(CDetectionModel, HidesAPosterOfWhichHalfIsCovered) {
    // Beams within 0.2 m of it: at 2 m these are 5.7 deg to each side.
    EXPECT_EQ(CDetectionModel::posterInView(views(), place(2, 10)), 0);
    const double partly = CDetectionModel::posterInView(views(), place(2, 6));
    EXPECT_GT(partly, 0.2);
    EXPECT_LT(partly, 0.8);
    EXPECT_NEAR(CDetectionModel::posterInView(views(), place(2, 3)), 1, 1e-6);
}

association::TAssociationProblem problem(ELandmarkKind kind, const std::vector<double>& bearings) {
    association::TAssociationProblem result;
    for (const double bearing : bearings) {
        association::TPredictedLandmark landmark;
        landmark.kind = kind;
        landmark.z = {3, bearing * degree};
        landmark.wallAngle = landmark.z[1] + M_PI;
        result.landmarks.push_back(landmark);
    }
    const auto size = static_cast<Eigen::Index>(2 * bearings.size());
    result.predictionCovariance = Eigen::MatrixXd::Zero(size, size);
    return result;
}

TEST(CDetectionModel, StatesAllLandmarksOfAStep) {
    const CDetectionModel model(tables());
    auto posed = problem(ELandmarkKind::salient, {0, 15, 100});
    posed.landmarks.push_back(posed.landmarks[0]);
    posed.landmarks[3].kind = ELandmarkKind::corner;
    posed.predictionCovariance = Eigen::MatrixXd::Zero(8, 8);
    model.state(views(), posed);
    EXPECT_NEAR(posed.landmarks[0].detection->probability(), 0.8, 1e-6);
    EXPECT_EQ(posed.landmarks[1].detection->probability(), 0);
    EXPECT_EQ(posed.landmarks[2].detection->probability(), 0);
    EXPECT_NEAR(posed.landmarks[3].detection->probability(), 0.6, 1e-9);
}

TEST(CDetectionModel, TurnsTheCovarianceOfRangeAndBearingIntoThatOfThePlace) {
    const CDetectionModel model(tables());
    // At the border of the field: only the bearing blurs it, only the range reaches past the wall.
    auto posed = problem(ELandmarkKind::salient, {-30, -30});
    posed.predictionCovariance.diagonal() << 0.16, 0, 0, 0.16 / 9;
    model.state(views(), posed);
    const auto& landmarks = posed.landmarks;
    EXPECT_GT(landmarks[0].detection->probability(), 1.2 * landmarks[1].detection->probability());
    EXPECT_NEAR(landmarks[0].detection->probability() / landmarks[1].detection->probability(),
                0.9998 / 0.815, 0.01);
}

TEST(CDetectionModel, SharesAPictureBetweenThePostersInIt) {
    const CDetectionModel model(tables());
    auto onePerPicture = views();
    onePerPicture.camera->mostPosters = 1;
    auto posed = problem(ELandmarkKind::salient, {0, -10, -20, 100});
    model.state(onePerPicture, posed);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(posed.landmarks[k].detection->probability(), 1. / 3, 1e-6) << k;
    EXPECT_EQ(posed.landmarks[3].detection->probability(), 0);
    // A record with more than that was made otherwise.
    posed.measurements.resize(2);
    for (auto& m : posed.measurements) m.kind = ELandmarkKind::salient;
    model.state(onePerPicture, posed);
    EXPECT_NEAR(posed.landmarks[0].detection->probability(), 2. / 3, 1e-6);
    posed.measurements.resize(3);
    posed.measurements[2].kind = ELandmarkKind::salient;
    model.state(onePerPicture, posed);
    EXPECT_NEAR(posed.landmarks[0].detection->probability(), 0.8, 1e-6);
}

TEST(CDetectionModel, KnowsTheReachAloneOfSensorsThatStateNoView) {
    const CDetectionModel model(tables(), {4, 60 * degree, 0.7});
    auto posed = problem(ELandmarkKind::corner, {0, 60, 100});
    posed.predictionCovariance.diagonal().setConstant(0.01);
    TViews nothing;
    model.state(nothing, posed);
    EXPECT_NEAR(posed.landmarks[0].detection->probability(), 0.7, 1e-6);
    EXPECT_NEAR(posed.landmarks[1].detection->probability(), 0.35, 1e-6);
    EXPECT_LT(posed.landmarks[2].detection->probability(), 1e-6);
    posed.landmarks[0].z[0] = 4;
    nothing.laser = views().laser;  // of an earlier scan
    model.state(nothing, posed);
    EXPECT_NEAR(posed.landmarks[0].detection->probability(), 0.35, 1e-6);
}

TEST(CDetectionModel, RefusesTablesThatDoNotFit) {
    auto options = tables();
    options.byCornerRange = {0.5};
    EXPECT_THROW(CDetectionModel{options}, std::invalid_argument);
}

}  // namespace
}  // namespace salma::slam
