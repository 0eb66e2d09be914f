// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/CRectifier.h>
#include <salma/appearance/TPolarMeasurement.h>

#include <Eigen/Dense>
#include <stdexcept>

#include "wallRenderer.h"

namespace salma::appearance {
namespace {

const TWallRectangle kPlace{-0.4, 0.3, 0.4, 0.9};

/// A chessboard of 8 x 6 squares of 0.1 m when hung at kPlace; the top left square is white.
cv::Mat chessboard() {
    cv::Mat board(600, 800, CV_8UC1);
    for (int r = 0; r < board.rows; ++r)
        for (int c = 0; c < board.cols; ++c)
            board.at<std::uint8_t>(r, c) = (r / 100 + c / 100) % 2 == 0 ? 220 : 30;
    return board;
}

CWallView viewFrom(double pan, const laser::TLine& wall) {
    return {test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, pan, 0.05), wall};
}

cv::Mat pictureOf(const CWallView& view) {
    std::mt19937 random(1);
    return test::renderPoster(view, chessboard(), kPlace, {}, random);
}

ERefusal refusalOf(const CWallView& view, const TWallRectangle& place) {
    const auto result =
        CRectifier().rectify(cv::Mat(480, 640, CV_8UC1, cv::Scalar(9)), view, place);
    EXPECT_EQ(result.patch.has_value(), result.refusal == ERefusal::none);
    return result.refusal;
}

TEST(CRectifier, ShowsSquaresAsSquaresFromWhereverTheyAreSeen) {
    for (const double alpha : {-0.9, -0.3, 0.0, 0.5, 0.9}) {  // up to 52 deg of incidence
        const CWallView view = viewFrom(alpha > 0 ? 0.02 : -0.02, test::wallLine(2.2, alpha));
        // hung where the camera's axis meets the wall
        const double u = 2.2 * std::tan(alpha);
        const TWallRectangle place{u - 0.4, 0.3, u + 0.4, 0.9};
        std::mt19937 random(1);
        const cv::Mat picture = test::renderPoster(view, chessboard(), place, {}, random);
        const auto result = CRectifier().rectify(picture, view, place);
        ASSERT_TRUE(result.patch) << asString(result.refusal);
        const cv::Mat patch = result.patch->picture.asCvMatRef();
        EXPECT_NEAR(patch.cols, 0.8 * result.patch->pixelsPerMetre, 1);
        for (int r = 0; r < 6; ++r)
            for (int c = 0; c < 8; ++c) {
                const double grey = patch.at<std::uint8_t>((2 * r + 1) * patch.rows / 12,
                                                           (2 * c + 1) * patch.cols / 16);
                EXPECT_NEAR(grey, (r + c) % 2 == 0 ? 220 : 30, 25)
                    << "square " << r << ", " << c << " at " << alpha;
            }
    }
}

TEST(CRectifier, FillsTheFieldsOfThePatch) {
    const CWallView view = viewFrom(0, test::wallLine(2, 0));
    const auto patch = CRectifier().rectify(pictureOf(view), view, kPlace).patch;
    ASSERT_TRUE(patch);
    EXPECT_NEAR(patch->width, 0.8, 1e-12);
    EXPECT_NEAR(patch->height, 0.6, 1e-12);
    EXPECT_LT(patch->quad[0].x, patch->quad[1].x);  // top left, top right, bottom right
    EXPECT_LT(patch->quad[1].y, patch->quad[2].y);
    EXPECT_LT(patch->quad[3].x, patch->quad[2].x);
    EXPECT_NEAR(patch->pose.mean.x(), 2, 1e-9);
    EXPECT_NEAR(patch->pose.mean.z(), 0.6, 1e-9);
    // u points to the robot's right, v up, the normal back to the robot
    const auto R = patch->pose.mean.getRotationMatrix();
    EXPECT_NEAR(R(1, 0), -1, 1e-9);
    EXPECT_NEAR(R(2, 1), 1, 1e-9);
    EXPECT_NEAR(R(0, 2), -1, 1e-9);
    EXPECT_NEAR(patch->incidence, std::atan2(0.1, 2), 1e-9);
    EXPECT_TRUE(patch->keypoints.empty());
}

TEST(CRectifier, RefusesRectanglesThatAreNone) {
    const CWallView view = viewFrom(0, test::wallLine(2, 0));
    EXPECT_EQ(refusalOf(view, kPlace), ERefusal::none);
    EXPECT_EQ(refusalOf(view, {-0.4, 0.3, -0.39, 0.9}), ERefusal::badRectangle) << "too narrow";
    EXPECT_EQ(refusalOf(view, {-0.4, 0.3, 0.4, 4.5}), ERefusal::badRectangle) << "too high";
    EXPECT_EQ(refusalOf(view, {0.4, 0.3, -0.4, 0.9}), ERefusal::badRectangle) << "inside out";
    EXPECT_EQ(refusalOf(view, {std::nan(""), 0.3, 0.4, 0.9}), ERefusal::badRectangle);
}

TEST(CRectifier, RefusesEntitiesThatThePictureCuts) {
    const CWallView view = viewFrom(0, test::wallLine(2, 0));
    EXPECT_EQ(refusalOf(view, {-0.4, 0.3, 2.5, 0.9}), ERefusal::outsidePicture);
    EXPECT_EQ(refusalOf(view, {-0.4, 0.3, 0.4, 1.9}), ERefusal::outsidePicture);
}

TEST(CRectifier, KeepsTheExtentOfWhatReachesALittleOutOfThePicture) {
    const CWallView view = viewFrom(0, test::wallLine(2, 0));
    const double right = view.toWall({638, 240})->x;  // where the picture ends
    const TWallRectangle little{right - 0.95, 0.3, right + 0.05, 0.9};
    const TWallRectangle much{right - 0.75, 0.3, right + 0.25, 0.9};
    EXPECT_EQ(refusalOf(view, much), ERefusal::outsidePicture);
    std::mt19937 random(1);
    const cv::Mat picture = test::renderPoster(view, chessboard(), little, {}, random);
    const auto patch = CRectifier().rectify(picture, view, little).patch;
    ASSERT_TRUE(patch);
    EXPECT_NEAR(patch->width, 1, 1e-12);
    EXPECT_NEAR(patch->pose.mean.y(), -(right - 0.45), 1e-9) << "the centre of the whole";
    EXPECT_GT(patch->quad[1].x, 640);
    const cv::Mat grey = patch->picture.asCvMatRef();
    const int seen = cvRound(0.95 * grey.cols);  // then the last pixel is repeated
    for (int i = 0; i < 6; ++i)                  // through the middles of the squares
        for (int c = seen + 3; c < grey.cols; ++c) {
            const int r = (2 * i + 1) * grey.rows / 12;
            EXPECT_NEAR(grey.at<std::uint8_t>(r, c), grey.at<std::uint8_t>(r, seen + 2), 2);
        }
    TRectificationOptions strict;
    strict.maxOutside = 0;
    EXPECT_EQ(CRectifier(strict).rectify(picture, view, little).refusal, ERefusal::outsidePicture);
}

TEST(CRectifier, RefusesWhatLiesBehindTheCamera) {
    EXPECT_EQ(refusalOf(viewFrom(M_PI, test::wallLine(2, 0)), kPlace), ERefusal::outsidePicture);
    // partly behind: the wall passes beside the camera
    const CWallView beside = viewFrom(0, test::wallLine(0.5, M_PI_2));
    EXPECT_EQ(refusalOf(beside, {-0.5, 0.3, 1.5, 0.9}), ERefusal::outsidePicture);
}

TEST(CRectifier, RefusesFrom75DegreesOn) {
    for (const double degrees : {74.5, 75.5}) {
        // 3 m to the poster, which is small: it is the same incidence all over it
        const double alpha = mrpt::DEG2RAD(degrees);
        const CWallView view(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, 0, 0),
                             test::wallLine(3 * std::cos(alpha), alpha));
        const double u = 3 * std::sin(alpha);
        EXPECT_NEAR(view.incidence(u, 0.5), alpha, 1e-9);
        EXPECT_EQ(refusalOf(view, {u - 0.03, 0.47, u + 0.03, 0.53}),
                  degrees < 75 ? ERefusal::none : ERefusal::grazing);
    }
}

TEST(CRectifier, RefusesBelow40PixelsPerMetre) {
    // 705 px of focal length: 40 px/m at 17.6 m
    const auto at = [](double distance) {
        const CWallView view(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, 0, 0),
                             test::wallLine(distance, 0));
        return refusalOf(view, {-0.2, 0.4, 0.2, 0.6});
    };
    EXPECT_EQ(at(17.4), ERefusal::none);
    EXPECT_EQ(at(17.8), ERefusal::coarse);
}

TEST(CRectifier, DoesNotRefuseAsCoarseWhatIsPerhapsFineEnough) {
    // 63 deg: 1 deg of the wall's angle means 7 % of the resolution along it
    const auto at = [](double distance, double angleSigma) {
        auto wall = test::wallLine(distance * std::cos(1.1), 1.1);
        wall.covariance(1, 1) = angleSigma * angleSigma;
        const CWallView view(test::pannedCamera(), test::panTiltPose({0, 0, 0.5}, 0, 0), wall);
        const double u = distance * std::sin(1.1);
        EXPECT_NEAR(view.pixelsPerMetre(u, 0.5), 705 / distance * std::cos(1.1), 0.01);
        return refusalOf(view, {u - 0.03, 0.47, u + 0.03, 0.53});
    };
    const double limit = 705 * std::cos(1.1) / 40;
    const double degree = mrpt::DEG2RAD(1.0);
    EXPECT_EQ(at(0.97 * limit, degree), ERefusal::none);
    EXPECT_EQ(at(1.08 * limit, degree), ERefusal::none);  // within two sigmas
    EXPECT_EQ(at(1.08 * limit, 0.001), ERefusal::coarse);
    EXPECT_EQ(at(1.25 * limit, degree), ERefusal::coarse);
}

TEST(CRectifier, RefusesPicturesThatAreNone) {
    const CWallView view = viewFrom(0, test::wallLine(2, 0));
    EXPECT_EQ(CRectifier().rectify({}, view, kPlace).refusal, ERefusal::noPicture);
    const cv::Mat other(100, 100, CV_8UC1, cv::Scalar(0));
    EXPECT_EQ(CRectifier().rectify(other, view, kPlace).refusal, ERefusal::noPicture);
    const cv::Mat colour(480, 640, CV_8UC3);
    EXPECT_THROW(CRectifier().rectify(colour, view, kPlace), std::invalid_argument);
}

TEST(CRectifier, RefusesPosesAndWallsThatAreNoNumbers) {
    const double nan = std::nan("");
    const auto wall = test::wallLine(2, 0);
    for (const auto& pose :
         {test::panTiltPose({nan, 0, 0.5}, 0, 0), test::panTiltPose({0, 0, nan}, 0, 0),
          test::panTiltPose({0, 0, 0.5}, nan, 0)}) {
        const CWallView view(test::pannedCamera(), pose, wall);
        EXPECT_EQ(refusalOf(view, kPlace), ERefusal::outsidePicture);
    }
    EXPECT_THROW(viewFrom(0, test::wallLine(2, nan)), std::invalid_argument) << "no laser line";
    auto unsure = wall;
    unsure.covariance(0, 1) = nan;
    EXPECT_EQ(refusalOf(viewFrom(0, unsure), kPlace), ERefusal::badWall);
    auto camera = test::pannedCamera();
    camera.setIntrinsicParamsFromValues(705, 705, nan, 239.5);
    const CWallView view(camera, test::panTiltPose({0, 0, 0.5}, 0, 0), wall);
    EXPECT_EQ(refusalOf(view, kPlace), ERefusal::outsidePicture);
}

TEST(CRectifier, LimitsTheResolutionOfACloseView) {
    const CWallView view = viewFrom(0, test::wallLine(0.8, 0));  // 880 px/m
    const TWallRectangle small{-0.1, 0.45, 0.1, 0.65};
    const auto patch = CRectifier().rectify(pictureOf(view), view, small).patch;
    ASSERT_TRUE(patch);
    EXPECT_EQ(patch->pixelsPerMetre, 400);
    EXPECT_EQ(patch->picture.getWidth(), 80U);
}

/// Mean NEES of all six coordinates over `runs`, and of (x, y, yaw) alone, when everything that the
/// covariance counts is drawn around the given view.
std::pair<double, double> poseNees(const CWallView& truth, double u, double v, int runs) {
    const TRectificationOptions options;
    const CRectifier rectifier(options);
    std::mt19937 random(3);
    std::normal_distribution<double> n;
    const Eigen::Vector3d X = truth.point(u, v);
    const mrpt::math::TPoint2D pixel = *truth.toPixel(u, v);
    std::pair<double, double> nees{0, 0};
    for (int i = 0; i < runs; ++i) {
        laser::TLine wall = truth.wall();
        wall.rho += std::sqrt(wall.covariance(0, 0)) * n(random) + options.wallSigma * n(random);
        wall.alpha += std::sqrt(wall.covariance(1, 1)) * n(random);
        const double a = options.extrinsicsSigma;
        const double t = options.extrinsicsSigmaXyz;
        const auto& T = truth.cameraPose();
        const mrpt::poses::CPose3D camera =
            mrpt::poses::CPose3D(T.x() + t * n(random), T.y() + t * n(random),
                                 T.z() + t * n(random), 0, 0, 0) +
            mrpt::poses::CPose3D(0, 0, 0, a * n(random), a * n(random), a * n(random)) +
            mrpt::poses::CPose3D(0, 0, 0, T.yaw(), T.pitch(), T.roll());
        const CWallView seen(truth.camera(), camera, wall);
        const auto uv = seen.toWall(
            {pixel.x + options.cameraSigma * n(random), pixel.y + options.cameraSigma * n(random)});
        const auto pose = rectifier.pose(seen, uv->x, uv->y);
        Eigen::Matrix<double, 6, 1> error;
        error << pose.mean.x() - X.x(), pose.mean.y() - X.y(),
            pose.mean.z() - X.z() + options.heightSigma * n(random),
            mrpt::math::wrapToPi(pose.mean.yaw() - (truth.wall().alpha - M_PI_2)),
            options.tiltSigma * n(random), options.tiltSigma * n(random);
        const Eigen::Matrix<double, 6, 6> P = pose.cov.asEigen();
        nees.first += error.dot(P.inverse() * error) / runs;
        const Eigen::Vector3d e(error[0], error[1], error[3]);
        Eigen::Matrix3d Q;
        const int rows[] = {0, 1, 3};
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) Q(r, c) = P(rows[r], rows[c]);
        nees.second += e.dot(Q.inverse() * e) / runs;
    }
    return nees;
}

TEST(CRectifier, StatesTheCovarianceOfThePoseThatTheErrorsHave) {
    constexpr int kRuns = 2000;
    const auto half = [](int freedom) { return 1.96 * std::sqrt(2.0 * freedom / kRuns); };
    for (const double alpha : {0.0, 0.6, -0.9, 1.1, -1.1}) {  // 63 deg
        laser::TLine wall = test::wallLine(1.5, alpha);
        wall.covariance << 2.5e-5, 0, 0, 1e-4;
        const CWallView view = viewFrom(0.1, wall);
        const auto nees = poseNees(view, 1.5 * std::tan(alpha), 0.7, kRuns);
        EXPECT_NEAR(nees.first, 6, half(6)) << alpha << ": 95 % interval";
        EXPECT_NEAR(nees.second, 3, half(3)) << alpha << ": 95 % interval";
    }
}

TEST(CRectifier, IsLessSureAlongTheWallTheMoreSlantingTheView) {
    const CRectifier rectifier;
    double last = 0;
    for (const double alpha : {0.0, 0.5, 0.9, 1.2}) {
        // the same 2 m to the poster each time
        const CWallView view = viewFrom(0, test::wallLine(2 * std::cos(alpha), alpha));
        const auto pose = rectifier.pose(view, 2 * std::sin(alpha), 0.5);
        const Eigen::Vector2d along(std::sin(alpha), -std::cos(alpha));
        Eigen::Matrix2d P;
        P << pose.cov(0, 0), pose.cov(0, 1), pose.cov(1, 0), pose.cov(1, 1);
        const double sigma = std::sqrt(along.dot(P * along));
        EXPECT_GT(sigma, last);
        last = sigma;
    }
}

TEST(PolarMeasurement, IsTheCentreInRangeAndBearingWithTheWallsNormal) {
    observations::TPatch patch;
    patch.pose.mean = mrpt::poses::CPose3D(3, 4, 1, -0.6, 0, M_PI_2);
    patch.pose.cov.setIdentity();
    patch.pose.cov *= 0.01;
    const auto m = polarMeasurement(patch);
    EXPECT_NEAR(m.z[0], 5, 1e-12);
    EXPECT_NEAR(m.z[1], std::atan2(4, 3), 1e-12);
    EXPECT_NEAR(m.R(0, 0), 0.01, 1e-12);
    EXPECT_NEAR(m.R(1, 1), 0.01 / 25, 1e-12);
    EXPECT_NEAR(m.R(0, 1), 0, 1e-12);
    const auto R = patch.pose.mean.getRotationMatrix();
    EXPECT_NEAR(std::cos(m.wallAngle), R(0, 2), 1e-12);
    EXPECT_NEAR(std::sin(m.wallAngle), R(1, 2), 1e-12);
    EXPECT_NEAR(m.wallAngleSigma, 0.1, 1e-12);
    patch.pose.mean = mrpt::poses::CPose3D();
    EXPECT_THROW(polarMeasurement(patch), std::invalid_argument);
}

TEST(PolarMeasurement, PropagatesAsCentralDifferencesDo) {
    const CWallView view = viewFrom(0.2, test::wallLine(2, 0.5));
    observations::TPatch patch;
    patch.pose = CRectifier().pose(view, 0.9, 0.6);
    Eigen::Matrix3d J;
    const double h = 1e-6;
    for (int i = 0; i < 3; ++i) {
        Eigen::Vector3d value[2];
        for (int side = 0; side < 2; ++side) {
            const double e = side == 0 ? h : -h;
            auto moved = patch;
            const auto& p = patch.pose.mean;
            moved.pose.mean =
                mrpt::poses::CPose3D(p.x() + (i == 0 ? e : 0), p.y() + (i == 1 ? e : 0), p.z(),
                                     p.yaw() + (i == 2 ? e : 0), p.pitch(), p.roll());
            const auto m = polarMeasurement(moved);
            value[side] = {m.z[0], m.z[1], m.wallAngle};
        }
        J.col(i) = (value[0] - value[1]) / (2 * h);
    }
    Eigen::Matrix3d P;
    const int rows[] = {0, 1, 3};
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) P(r, c) = patch.pose.cov(rows[r], rows[c]);
    EXPECT_LT((polarMeasurement(patch).full - J * P * J.transpose()).norm(), 1e-9);
}

}  // namespace
}  // namespace salma::appearance
