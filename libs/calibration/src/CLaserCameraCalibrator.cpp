// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/CMatrixFixed.h>
#include <salma/calibration/CCameraCalibrator.h>
#include <salma/calibration/CLaserCameraCalibrator.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "CFitRounds.h"
#include "CJointFit.h"
#include "CPoseSearch.h"

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;
using mrpt::poses::CPose3D;
using TBeams = CFitRounds::TBeams;

/// Worse, the boards do not determine the pose.
constexpr double kWorstShift = 0.1;  ///< [m]
constexpr double kWorstTurn = 0.05;  ///< [rad]

void checkPairs(const std::vector<TPoint2D>& board, const std::vector<TLaserBoardPair>& pairs) {
    for (const auto& pair : pairs) {
        if (pair.pixels.size() != board.size())
            throw std::invalid_argument(pair.name + ": " + std::to_string(pair.pixels.size()) +
                                        " points for a board of " + std::to_string(board.size()));
        for (const auto& p : pair.pixels)
            if (!std::isfinite(p.x) || !std::isfinite(p.y))
                throw std::invalid_argument(pair.name + ": a point that is not finite");
        if (pair.scan.ranges.size() < 2 || !(std::abs(pair.scan.step) > 0))
            throw std::invalid_argument(pair.name + ": a scan without ranges");
    }
}

TBoardInScan boardOf(const CPose3D& T_c_b, const TOutline& outline) {
    const auto R = T_c_b.getRotationMatrix();
    TBoardInScan board;
    for (int i = 0; i < 3; ++i) board.plane.normal[i] = R(i, 2);
    const auto centre = T_c_b.composePoint(mrpt::math::TPoint3D(
        (outline.left + outline.right) / 2, (outline.top + outline.bottom) / 2, 0));
    board.centre = {centre.x, centre.y, centre.z};
    board.plane.distance = board.plane.normal.dot(board.centre);
    board.radius = std::hypot(outline.right - outline.left, outline.bottom - outline.top) / 2;
    return board;
}

std::array<double, 6> stateOf(const CPose3D& T_c_b) {
    TJointState helper;
    TLaserPose pose;
    const auto R = T_c_b.getRotationMatrix();
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) pose.R(r, c) = R(r, c);
    pose.t = {T_c_b.x(), T_c_b.y(), T_c_b.z()};
    helper.setPose(pose);
    std::array<double, 6> state{};
    std::copy_n(helper.laser.begin(), 6, state.begin());
    return state;
}

CPose3D asPose(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
    mrpt::math::CMatrixDouble44 T = mrpt::math::CMatrixDouble44::Identity();
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) T(r, c) = R(r, c);
        T(r, 3) = t[r];
    }
    return CPose3D(T);
}

/// (x, y, z, yaw, pitch, roll) of the camera in the laser's frame, and the offset.
Eigen::Matrix<double, 7, 1> asMrpt(const std::array<double, 8>& laser) {
    const TLaserPose T_c_l = TJointState{laser, {}}.pose();
    const CPose3D T_l_c = asPose(T_c_l.R.transpose(), -T_c_l.R.transpose() * T_c_l.t);
    Eigen::Matrix<double, 7, 1> v;
    v << T_l_c.x(), T_l_c.y(), T_l_c.z(), T_l_c.yaw(), T_l_c.pitch(), T_l_c.roll(), laser[6];
    return v;
}

/// By central differences, angles wrapped.
Eigen::Matrix<double, 7, 7> derivativeOfMrpt(const std::array<double, 8>& laser) {
    constexpr double step = 1e-6;
    Eigen::Matrix<double, 7, 7> J;
    for (std::size_t i = 0; i < 7; ++i) {
        auto up = laser, down = laser;
        up[i] += step, down[i] -= step;
        Eigen::Matrix<double, 7, 1> change = asMrpt(up) - asMrpt(down);
        for (int k = 3; k < 6; ++k) change[k] = std::remainder(change[k], 2 * M_PI);
        J.col(static_cast<Eigen::Index>(i)) = change / (2 * step);
    }
    return J;
}

double medianOf(std::vector<double> values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::vector<double> distancesOf(const CJointFit& fit,
                                const TLaserBoardPair& pair,
                                std::size_t index,
                                const std::vector<std::size_t>& beams,
                                const TJointState& state) {
    std::vector<double> distances;
    const TLaserPose pose = state.pose();
    const TPlane plane = state.plane(index);
    for (const std::size_t beam : beams) {
        const double offset = state.offset(fit.meetsDark(index, beam, state));
        const double r = pair.scan.ranges[beam] - offset, a = pair.scan.direction(beam);
        distances.push_back(plane.offset(pose.map(r * std::cos(a), r * std::sin(a))));
    }
    return distances;
}

/// Each block of neighbouring pairs against the pose that the other blocks give. Pictures taken one
/// after the other are alike: one of them alone would not be left out.
void holdOut(const TLaserCameraOptions& options,
             const CJointFit& fit,
             const CFitRounds& rounds,
             const std::vector<TLaserBoardPair>& pairs,
             const TJointState& start,
             TLaserCameraCalibration& result) {
    const std::size_t n = pairs.size(),
                      folds = std::min(n, static_cast<std::size_t>(options.folds));
    const auto foldOf = [&](std::size_t i) { return i * folds / n; };
    for (std::size_t fold = 0; fold < folds; ++fold) {
        std::vector<bool> use(n);
        for (std::size_t i = 0; i < n; ++i) use[i] = foldOf(i) != fold;
        std::size_t left = 0;
        for (std::size_t i = 0; i < n; ++i) left += use[i] && result.pairs[i].used ? 1 : 0;
        if (left < static_cast<std::size_t>(options.minPairs)) continue;
        TJointState state = start;
        rounds.run(use, state);
        state.boards = start.boards;
        for (std::size_t i = 0; i < n; ++i) {
            if (use[i] || !result.pairs[i].used) continue;
            const auto beams = rounds.beamsOn(i, state, 2 * options.tolerance);
            result.pairs[i].heldOutDistances = distancesOf(fit, pairs[i], i, beams, state);
        }
    }
}

double medianDistance(const std::vector<TPairFit>& pairs, std::vector<double> TPairFit::*which) {
    std::vector<double> all;
    for (const auto& pair : pairs)
        for (const double d : pair.*which) all.push_back(std::abs(d));
    return medianOf(std::move(all));
}

}  // namespace

void TLaserCameraOptions::visit(config::COptionVisitor& v) {
    v.number("max_baseline_m", maxBaseline, config::moreThan(0),
             "the laser stands no farther from the camera");
    v.number("margin_squares", margin, config::between(0, 10),
             "of the board around its points, this much is used");
    v.number("tolerance_m", tolerance, config::moreThan(0),
             "a piece of a scan this near to the board's plane agrees with it");
    v.number("gate_sigma", gate, config::atLeast(2), "points farther from the plane are not used");
    v.integer("samples", samples, config::between(1, 1e7), "random starts");
    v.integer("min_pairs", minPairs, config::between(5, 1e6),
              "pictures and scans that must agree on the pose");
    v.integer("min_points", minPoints, config::between(3, 1e6), "of a scan, on one board");
    v.flag("estimate_dark", estimateDark, "whether a further offset on dark squares is estimated");
    v.flag("estimate_offset", estimateOffset, "whether a constant offset of ranges is estimated");
    v.integer("folds", folds, config::between(2, 1000),
              "blocks of neighbouring pairs, each left out once");
    v.integer("seed", seed, config::atLeast(0), "of the random starts");
}

std::size_t TLaserCameraCalibration::usedPairs() const {
    return static_cast<std::size_t>(
        std::count_if(pairs.begin(), pairs.end(), [](const auto& p) { return p.used; }));
}

double TLaserCameraCalibration::medianFitted() const {
    return medianDistance(pairs, &TPairFit::distances);
}

double TLaserCameraCalibration::medianHeldOut() const {
    return medianDistance(pairs, &TPairFit::heldOutDistances);
}

CLaserCameraCalibrator::CLaserCameraCalibrator(const TLaserCameraOptions& options)
    : m_options(options) {
    m_options.validate();
}

TLaserCameraCalibration CLaserCameraCalibrator::calibrate(
    const mrpt::img::TCamera& camera,
    const TBoard& board,
    const std::vector<TLaserBoardPair>& pairs) const {
    board.validate();
    const auto points = board.points();
    checkPairs(points, pairs);
    const TOutline outline(points, m_options.margin * board.square);
    std::vector<TBoardInScan> boards;
    TJointState start;
    for (const auto& pair : pairs) {
        const auto pose = locateBoard(camera, points, pair.pixels);
        if (!pose) throw std::runtime_error(pair.name + ": its points are no board");
        boards.push_back(boardOf(pose->T_c_b, outline));
        boards.back().pieces = piecesOf(pair.scan, boards.back(), m_options);
        start.boards.push_back(stateOf(pose->T_c_b));
    }
    const auto found = CPoseSearch(boards, m_options).find();
    if (!found)
        throw std::runtime_error("no pose of the camera agrees with " +
                                 std::to_string(m_options.minPairs) + " of the " +
                                 std::to_string(pairs.size()) + " pairs of picture and scan");
    start.setPose(*found);

    TJointState state = start;
    CJointFit fit(camera, board, pairs, m_options);
    const CFitRounds rounds(m_options, outline, pairs, fit);
    const TBeams beams = rounds.run(std::vector<bool>(pairs.size(), true), state);
    TLaserCameraCalibration result;
    const auto covariance = fit.covariance(beams, state);
    if (covariance) {
        const auto J = derivativeOfMrpt(state.laser);
        result.covariance = J * covariance->topLeftCorner<7, 7>() * J.transpose();
        result.sigmaDark = std::sqrt((*covariance)(7, 7));
    }
    const Eigen::Matrix<double, 7, 1> sigma = result.covariance.diagonal().cwiseSqrt();
    if (!covariance || !(sigma.head<3>().maxCoeff() <= kWorstShift) ||
        !(sigma.segment<3>(3).maxCoeff() <= kWorstTurn))
        throw std::runtime_error(
            "the boards do not determine the camera's pose: hold them in more directions");
    const TLaserPose T_c_l = state.pose();
    result.T_l_c = asPose(T_c_l.R.transpose(), -T_c_l.R.transpose() * T_c_l.t);
    result.rangeOffset = state.laser[6];
    result.darkOffset = state.laser[7];
    result.sigmaRange = fit.sigmaRange;
    result.sigmaPixels = fit.sigmaPixels;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        TPairFit one;
        one.used = !beams[i].empty();
        const auto& b = state.boards[i];
        one.T_c_b = asPose(TJointState{{b[0], b[1], b[2]}, {}}.pose().R, {b[3], b[4], b[5]});
        one.beams = beams[i];
        result.pairs.push_back(std::move(one));
    }
    // To the planes as the pictures alone show them, for boards that were fitted as for others.
    state.boards = start.boards;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (result.pairs[i].used)
            result.pairs[i].distances = distancesOf(
                fit, pairs[i], i, rounds.beamsOn(i, state, 2 * m_options.tolerance), state);
    holdOut(m_options, fit, rounds, pairs, start, result);
    return result;
}

}  // namespace salma::calibration
