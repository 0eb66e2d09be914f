// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/calibration/CTsaiGrid.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>

#include "CSimulatedRig.h"
#include "tsaiPicture.h"

namespace salma::calibration {
namespace {

/// Corners of two boards as the camera of TTsaiCamera sees them, with normal noise.
std::vector<TSpacePoint> pointsOf(const TTsaiCamera& camera, double sigma, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 1);
    std::vector<TSpacePoint> points;
    for (int i = 1; i < 10; ++i)
        for (int k = 1; k < 7; ++k)
            for (const bool up : {true, false}) {
                const Eigen::Vector3d X(0.02 * i, up ? 0.02 * k : 0, up ? 0 : 0.02 * k);
                const Eigen::Vector3d x = camera.K * (camera.R * X + camera.t);
                points.push_back({{X.x(), X.y(), X.z()},
                                  {x.x() / x.z() + sigma * noise(random),
                                   x.y() / x.z() + sigma * noise(random)}});
            }
    return points;
}

TEST(CameraMatrix, IsExactWithoutNoise) {
    const TTsaiCamera truth;
    const auto points = pointsOf(truth, 0, 1);
    const auto camera = CCameraMatrix::through(points);
    ASSERT_TRUE(camera);
    EXPECT_LT((camera->K() - truth.K).norm(), 1e-6);
    EXPECT_LT((camera->R() - truth.R).norm(), 1e-9);
    EXPECT_LT((camera->t() - truth.t).norm(), 1e-9);
    EXPECT_LT(camera->rms(points), 1e-8);
    const auto six = std::vector<TSpacePoint>{points[0],  points[1],  points[40],
                                              points[57], points[90], points[107]};
    const auto fewest = CCameraMatrix::through(six);
    ASSERT_TRUE(fewest);
    EXPECT_LT((fewest->K() - truth.K).norm(), 1e-4);
}

TEST(CameraMatrix, IsRefinedToLessThanTheLinearError) {
    const TTsaiCamera truth;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const auto points = pointsOf(truth, 0.3, seed);
        const auto linear = CCameraMatrix::through(points);
        ASSERT_TRUE(linear);
        const auto refined = linear->refined(points);
        EXPECT_LE(refined.rms(points), linear->rms(points) + 1e-9);
        EXPECT_NEAR(refined.rms(points), 0.3 * std::sqrt(2), 0.08);
        EXPECT_NEAR(refined.K()(0, 0), truth.K(0, 0), 15);
        const Eigen::Vector3d X(0.1, 0.05, 0.05), x = refined.P() * X.homogeneous();
        const auto projected = refined.project({0.1, 0.05, 0.05});
        EXPECT_NEAR(projected.x, x.x() / x.z(), 1e-9);
        EXPECT_NEAR(projected.y, x.y() / x.z(), 1e-9);
    }
}

TEST(CameraMatrix, RefusesPointsThatDetermineNone) {
    const auto good = pointsOf(TTsaiCamera(), 0, 1);
    EXPECT_FALSE(CCameraMatrix::through({}));
    EXPECT_FALSE(CCameraMatrix::through({good.begin(), good.begin() + 5}));
    std::vector<TSpacePoint> plane, line, mirrored = good, holed = good;
    for (const auto& p : good) {
        if (p.world.z == 0) plane.push_back(p);
        if (p.world.z == 0 && p.world.y < 0.03) line.push_back(p);
    }
    EXPECT_FALSE(CCameraMatrix::through(plane));
    EXPECT_FALSE(CCameraMatrix::through(line));
    EXPECT_FALSE(CCameraMatrix::through(std::vector<TSpacePoint>(30, good[0])));
    for (auto& p : mirrored) p.world.x = -p.world.x;
    EXPECT_FALSE(CCameraMatrix::through(mirrored));
    holed[7].pixel.x = std::nan("");
    EXPECT_FALSE(CCameraMatrix::through(holed));
}

TEST(TsaiGrid, FindsTheCameraOfAPicture) {
    const TTsaiCamera truth;
    const auto result = CTsaiGrid().calibrate(tsaiPicture(truth.K, truth.R, truth.t), 0.02);
    EXPECT_GE(result.points.size(), 100u);
    EXPECT_LT(result.camera.rms(result.points), 0.3);
    EXPECT_NEAR(result.camera.K()(0, 0), 900, 20);
    EXPECT_NEAR(result.camera.K()(1, 1), 890, 20);
    EXPECT_NEAR(result.camera.K()(0, 2), 410, 15);
    EXPECT_NEAR(result.camera.K()(1, 2), 290, 15);
    EXPECT_LT((result.camera.R() - truth.R).norm(), 0.03);
    for (const auto& p : result.points) EXPECT_TRUE(p.world.y == 0 || p.world.z == 0);
}

TEST(TsaiGrid, FindsTheSameInAPictureTwiceAsLarge) {
    const TTsaiCamera truth;
    const cv::Mat picture = tsaiPicture(truth.K, truth.R, truth.t);
    TTsaiOptions options;
    options.workingSize = 800;
    cv::Mat large;
    cv::resize(picture, large, {}, 2, 2, cv::INTER_CUBIC);
    const auto result = CTsaiGrid(options).calibrate(large, 0.02);
    EXPECT_NEAR(result.camera.K()(0, 0), 1800, 50);
    EXPECT_NEAR(result.camera.K()(0, 2), 2 * 410.5 - 0.5, 30);
}

TEST(TsaiGrid, RefusesPicturesWithoutTwoBoards) {
    const TTsaiCamera truth;
    const CTsaiGrid grid;
    EXPECT_THROW(grid.calibrate(cv::Mat(100, 100, CV_8UC3), 0.02), std::invalid_argument);
    EXPECT_THROW(grid.calibrate(cv::Mat(100, 100, CV_8UC1), 0), std::invalid_argument);
    EXPECT_THROW(grid.calibrate(cv::Mat(100, 100, CV_8UC1, cv::Scalar(9)), std::nan("")),
                 std::invalid_argument);
    EXPECT_THROW(grid.calibrate(cv::Mat(1, 1, CV_8UC1, cv::Scalar(9)), 0.02), std::runtime_error);
    EXPECT_THROW(grid.calibrate(cv::Mat(300, 400, CV_8UC1, cv::Scalar(9)), 0.02),
                 std::runtime_error);
    cv::Mat noise(300, 400, CV_8U);
    cv::RNG(5).fill(noise, cv::RNG::UNIFORM, 0, 256);
    EXPECT_THROW(grid.calibrate(noise, 0.02), std::runtime_error);
    cv::Mat flat(600, 800, CV_8U);  // one board, seen straight on
    for (int v = 0; v < flat.rows; ++v)
        for (int u = 0; u < flat.cols; ++u)
            flat.at<unsigned char>(v, u) = (u / 60 + v / 60) % 2 == 0 ? 30 : 220;
    EXPECT_THROW(grid.calibrate(flat, 0.02), std::runtime_error);
    CSimulatedRig rig(3);  // one board, askew and through a lens that distorts
    rig.pairs(3);
    for (const auto& pose : rig.boards())
        EXPECT_THROW(grid.calibrate(rig.picture(pose), 0.1), std::runtime_error);
}

TEST(TsaiGrid, AgreesWithPointsThatWereMeasuredByHand) {
    SALMA_NEED_DATA(folder, "calibration/tsai_katageri");
    const cv::Mat grey = cv::imread(folder + "/1.jpeg", cv::IMREAD_GRAYSCALE);
    const auto measured = readPoints(folder + "/1.txt", 1e-3);
    ASSERT_EQ(measured.size(), 8u);
    const auto result = CTsaiGrid().calibrate(grey, 0.02);
    EXPECT_GE(result.points.size(), 120u);
    // The squares were drawn by hand, half a millimetre off, which is 8 px of these 4312 x 5760.
    EXPECT_LT(result.camera.rms(result.points), 8);
    EXPECT_LT(result.camera.rms(measured), 9);
    const auto byHand = CCameraMatrix::through(measured);
    ASSERT_TRUE(byHand);
    EXPECT_NEAR(result.camera.K()(0, 0), byHand->K()(0, 0), 0.03 * byHand->K()(0, 0));
}

TEST(ReadPoints, NamesFileLineAndValueOfAMistake) {
    const test::CTemporaryFolder folder;
    const auto message = [&](const std::string& text) {
        const std::string file = folder.write("points.txt", text);
        try {
            readPoints(file);
        } catch (const std::runtime_error& e) {
            return std::string(e.what()).substr(file.size());
        }
        return std::string();
    };
    const auto points =
        readPoints(folder.write("p.txt", "# a\n\n1 2 3 4 5\r\n-1,2e1, 3\t4 5\n"), 2);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[1].world.x, -2);
    EXPECT_EQ(points[1].world.y, 40);
    EXPECT_EQ(points[1].pixel.y, 5);
    EXPECT_EQ(message("1 2 3 4 5\n1 2 3 4\n"), ":2: has 4 numbers, not x y z u v");
    EXPECT_EQ(message("1 2 3 4 5 6\n"), ":1: '6' follows x y z u v");
    EXPECT_EQ(message("1 2 x 4 5\n"), ":1: 'x' is no number");
    EXPECT_EQ(message("1 2 nan 4 5\n"), ":1: 'nan' is no number");
    EXPECT_EQ(message("1 2 1e999 4 5\n"), ":1: '1e999' is no number");
    EXPECT_THROW(readPoints(folder.path().string()), std::runtime_error);
    EXPECT_THROW(readPoints((folder / "none").string()), std::runtime_error);
}

TEST(ReadPoints, EitherReadsOrNamesTheLineOfDamagedText) {
    const test::CTemporaryFolder folder;
    const std::string good = "# grid\n20 160 0 860 1320\n40,160,0,1112,1308\n40 140 0 1191 1596\n";
    std::mt19937 random(3);
    int refused = 0;
    for (int i = 0; i < 500; ++i) {
        std::string text = good;
        for (unsigned k = random() % 3 + 1; k > 0; --k) {
            const std::size_t at = random() % text.size();
            if (random() % 2 == 0)
                text[at] = static_cast<char>(random() % 256);
            else
                text.erase(at, random() % 5);
        }
        const std::string file = folder.write("points.txt", text);
        try {
            for (const auto& p : readPoints(file))
                ASSERT_TRUE(std::isfinite(p.world.z + p.pixel.x));
        } catch (const std::runtime_error& e) {
            ++refused;
            ASSERT_EQ(std::string(e.what()).compare(0, file.size() + 1, file + ":"), 0) << e.what();
        }
    }
    EXPECT_GT(refused, 150);
}

}  // namespace
}  // namespace salma::calibration
