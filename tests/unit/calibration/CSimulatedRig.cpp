// SPDX-License-Identifier: BSD-3-Clause
#include "CSimulatedRig.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>

namespace salma::calibration {
namespace {

using mrpt::math::TPoint3D;
using mrpt::poses::CPose3D;

constexpr int kBeams = 361;

/// Distance to the walls of the room [m].
double roomRange(double x, double y) {
    double nearest = std::numeric_limits<double>::infinity();
    if (x > 0) nearest = std::min(nearest, 6 / x);
    if (x < 0) nearest = std::min(nearest, -2 / x);
    if (y > 0) nearest = std::min(nearest, 2.5 / y);
    if (y < 0) nearest = std::min(nearest, -3.5 / y);
    return nearest;
}

}  // namespace

CSimulatedRig::CSimulatedRig(unsigned seed) : m_random(seed) {
    m_camera.ncols = 640;
    m_camera.nrows = 480;
    m_camera.setIntrinsicParamsFromValues(520, 522, 318, 244);
    m_camera.setDistortionPlumbBob(-0.25, 0.1, 0.001, -0.0005, 0);
    m_board.square = 0.1;
    // looks ahead (yaw -90, roll -90), a little askew, 15 cm above the laser
    m_T_l_c = CPose3D(0.08, -0.05, 0.15, -1.52, 0.03, -1.62);
}

std::vector<TLaserBoardPair> CSimulatedRig::pairs(int count) {
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<TLaserBoardPair> all;
    m_boards.clear();
    while (all.size() < static_cast<std::size_t>(count)) {
        const double z = 1.7 + 0.5 * unit(m_random);
        // rotations about the board's middle, seen from the camera
        const CPose3D middle(0.35 * z * unit(m_random), 0.25 * z * unit(m_random), z,
                             0.5 * unit(m_random), tilt * unit(m_random), tilt * unit(m_random));
        const CPose3D T_c_b = middle + CPose3D(-0.4, -0.25, 0, 0, 0, 0);
        TLaserBoardPair pair;
        pair.name = "picture " + std::to_string(all.size());
        if (!shows(T_c_b, pair) || scan(m_T_l_c + T_c_b, pair) < 25) continue;
        all.push_back(pair);
        m_boards.push_back(T_c_b);
    }
    return all;
}

bool CSimulatedRig::shows(const CPose3D& T_c_b, TLaserBoardPair& pair) {
    std::vector<cv::Point3d> inCamera;
    for (const auto& p : m_board.points()) {
        const TPoint3D q = T_c_b.composePoint(TPoint3D(p.x, p.y, 0));
        inCamera.emplace_back(q.x, q.y, q.z);
    }
    const cv::Matx33d K(m_camera.fx(), 0, m_camera.cx(), 0, m_camera.fy(), m_camera.cy(), 0, 0, 1);
    const std::vector<double> lens(m_camera.dist.begin(), m_camera.dist.begin() + 5);
    std::vector<cv::Point2d> pixels;
    cv::projectPoints(inCamera, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), K, lens, pixels);
    std::normal_distribution<double> noise(0, sigmaPixels);
    for (const auto& p : pixels) {
        if (!(p.x > 10 && p.x < 629 && p.y > 10 && p.y < 469)) return false;
        pair.pixels.emplace_back(p.x + noise(m_random), p.y + noise(m_random));
    }
    return true;
}

int CSimulatedRig::scan(const CPose3D& T_l_b, TLaserBoardPair& pair) {
    std::normal_distribution<double> noise(0, sigmaRange);
    const auto R = T_l_b.getRotationMatrix();
    pair.scan.start = -M_PI / 2;
    pair.scan.step = M_PI / (kBeams - 1);
    int hits = 0;
    for (int i = 0; i < kBeams; ++i) {
        const double a = pair.scan.direction(static_cast<std::size_t>(i));
        const double x = std::cos(a), y = std::sin(a);
        double range = roomRange(x, y);
        const double rate = R(0, 2) * x + R(1, 2) * y;
        const double toPlane =
            (R(0, 2) * T_l_b.x() + R(1, 2) * T_l_b.y() + R(2, 2) * T_l_b.z()) / rate;
        TPoint3D onBoard;
        T_l_b.inverseComposePoint(TPoint3D(toPlane * x, toPlane * y, 0), onBoard);
        // the board is one square larger than its inner corners on every side
        const bool meets = toPlane > 0 && toPlane < range && onBoard.x > -0.1 && onBoard.x < 0.9 &&
                           onBoard.y > -0.1 && onBoard.y < 0.6;
        if (meets) {
            const double s = m_board.square;
            const int cells =
                static_cast<int>(std::floor(onBoard.x / s) + std::floor(onBoard.y / s));
            range = toPlane + (cells % 2 == 0 ? dark : 0);
            ++hits;
        }
        pair.scan.ranges.push_back(range + offset + noise(m_random));
    }
    return hits;
}

cv::Mat CSimulatedRig::picture(const CPose3D& T_c_b) const {
    constexpr int fine = 3;  // samples along each side of a pixel
    const cv::Matx33d K(m_camera.fx(), 0, m_camera.cx(), 0, m_camera.fy(), m_camera.cy(), 0, 0, 1);
    const std::vector<double> lens(m_camera.dist.begin(), m_camera.dist.begin() + 5);
    const auto R = T_c_b.getRotationMatrix();
    std::vector<cv::Point2d> samples, rays;
    for (int i = 0; i < fine * static_cast<int>(m_camera.ncols); ++i)
        samples.emplace_back((i + 0.5) / fine - 0.5, 0);
    cv::Mat sum(static_cast<int>(m_camera.nrows), static_cast<int>(m_camera.ncols), CV_32F,
                cv::Scalar(0));
    const double s = m_board.square;
    for (int v = 0; v < fine * sum.rows; ++v) {
        for (auto& p : samples) p.y = (v + 0.5) / fine - 0.5;
        cv::undistortPoints(samples, rays, K, lens);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const double x = rays[i].x, y = rays[i].y;
            const double depth = (R(0, 2) * T_c_b.x() + R(1, 2) * T_c_b.y() + R(2, 2) * T_c_b.z()) /
                                 (R(0, 2) * x + R(1, 2) * y + R(2, 2));
            TPoint3D p;
            T_c_b.inverseComposePoint(TPoint3D(depth * x, depth * y, depth), p);
            const int column = static_cast<int>(std::floor(p.x / s)) + 1;
            const int row = static_cast<int>(std::floor(p.y / s)) + 1;
            const bool inside = depth > 0 && column >= 0 && row >= 0 && column <= m_board.columns &&
                                row <= m_board.rows;
            const bool paper = depth > 0 && column >= -1 && row >= -1 &&
                               column <= m_board.columns + 1 && row <= m_board.rows + 1;
            const float grey = inside && (column + row) % 2 == 0 ? 30.0F : paper ? 220.0F : 120.0F;
            sum.at<float>(v / fine, static_cast<int>(i) / fine) += grey / (fine * fine);
        }
    }
    cv::Mat grey;
    sum.convertTo(grey, CV_8U);
    return grey;
}

}  // namespace salma::calibration
