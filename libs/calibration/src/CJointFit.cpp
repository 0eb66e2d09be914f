// SPDX-License-Identifier: BSD-3-Clause
#include "CJointFit.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "lensModel.h"

namespace salma::calibration {
namespace {

using TBeams = std::vector<std::vector<std::size_t>>;

constexpr double kHuber = 3;  ///< [sigma] Linear beyond.

/// Measured minus expected pixel of one corner.
struct TCornerCost {
    const mrpt::img::TCamera& camera;
    mrpt::math::TPoint2D corner;  //!< On the board [m].
    mrpt::math::TPoint2D pixel;
    double sigma;

    template <typename T>
    bool operator()(const T* board, T* residual) const {
        const T point[3] = {T(corner.x), T(corner.y), T(0)};
        T X[3];
        ceres::AngleAxisRotatePoint(board, point, X);
        for (int i = 0; i < 3; ++i) X[i] += board[3 + i];
        if (!(X[2] > T(1e-6))) return false;
        T uv[2];
        project(lensOf<T>(camera), X, uv);
        residual[0] = (T(pixel.x) - uv[0]) / T(sigma);
        residual[1] = (T(pixel.y) - uv[1]) / T(sigma);
        return true;
    }
};

/// Measured minus expected range of one beam: the range at which it meets the board's plane.
struct TRangeCost {
    double direction;
    double range;
    bool dark;
    double sigma;

    template <typename T>
    bool operator()(const T* laser, const T* board, T* residual) const {
        const T axis[3] = {T(0), T(0), T(1)};
        const T beam[3] = {T(std::cos(direction)), T(std::sin(direction)), T(0)};
        T normal[3], along[3];
        ceres::AngleAxisRotatePoint(board, axis, normal);
        ceres::AngleAxisRotatePoint(laser, beam, along);
        T distance = T(0), rate = T(0);
        for (int i = 0; i < 3; ++i) {
            distance += normal[i] * (board[3 + i] - laser[3 + i]);
            rate += normal[i] * along[i];
        }
        if (!(rate * rate > T(1e-6))) return false;
        const T offset = dark ? laser[6] + laser[7] : laser[6];
        residual[0] = (T(range) - offset - distance / rate) / T(sigma);
        return true;
    }
};

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Eigen::Matrix3d rotation(const double* vector) {
    Eigen::Matrix3d R;
    ceres::AngleAxisToRotationMatrix(vector, R.data());
    return R;
}

}  // namespace

TLaserPose TJointState::pose() const {
    return {rotation(laser.data()), {laser[3], laser[4], laser[5]}};
}

void TJointState::setPose(const TLaserPose& pose) {
    ceres::RotationMatrixToAngleAxis(pose.R.data(), laser.data());
    for (int i = 0; i < 3; ++i) laser[static_cast<std::size_t>(3 + i)] = pose.t[i];
}

TPlane TJointState::plane(std::size_t board) const {
    const auto& b = boards[board];
    const Eigen::Vector3d normal = rotation(b.data()).col(2);
    return {normal, normal.dot(Eigen::Vector3d(b[3], b[4], b[5]))};
}

Eigen::Vector3d TJointState::onBoard(std::size_t board, const Eigen::Vector3d& X) const {
    const auto& b = boards[board];
    return rotation(b.data()).transpose() * (X - Eigen::Vector3d(b[3], b[4], b[5]));
}

/// The state as Ceres changes it, and the residuals over it.
struct CJointFit::TProblem {
    TJointState state;
    ceres::Problem problem;

    TProblem(const CJointFit& fit, const TBeams& beams, const TJointState& start) : state(start) {
        problem.AddParameterBlock(state.laser.data(), 8);
        std::vector<int> fixed;
        if (!fit.m_estimateOffset) fixed.push_back(6);
        if (!fit.m_estimateDark) fixed.push_back(7);
        if (!fixed.empty())
            problem.SetManifold(state.laser.data(), new ceres::SubsetManifold(8, fixed));
        for (std::size_t i = 0; i < fit.m_pairs.size(); ++i) addPair(fit, i, beams[i]);
    }

    void addPair(const CJointFit& fit, std::size_t i, const std::vector<std::size_t>& beams) {
        if (beams.empty()) return;  // a board that no beam met tells nothing of the laser
        double* board = state.boards[i].data();
        const auto& pair = fit.m_pairs[i];
        for (std::size_t k = 0; k < fit.m_board.size(); ++k)
            problem.AddResidualBlock(
                new ceres::AutoDiffCostFunction<TCornerCost, 2, 6>(
                    new TCornerCost{fit.m_camera, fit.m_board[k], pair.pixels[k], fit.sigmaPixels}),
                new ceres::HuberLoss(kHuber), board);
        for (const std::size_t beam : beams)
            problem.AddResidualBlock(
                new ceres::AutoDiffCostFunction<TRangeCost, 1, 8, 6>(
                    new TRangeCost{pair.scan.direction(beam), pair.scan.ranges[beam],
                                   fit.meetsDark(i, beam, state), fit.sigmaRange}),
                new ceres::HuberLoss(kHuber), state.laser.data(), board);
    }
};

CJointFit::CJointFit(const mrpt::img::TCamera& camera,
                     const TBoard& board,
                     const std::vector<TLaserBoardPair>& pairs,
                     const TLaserCameraOptions& options)
    : m_camera(camera),
      m_board(board.points()),
      m_square(board.square),
      m_pairs(pairs),
      m_estimateOffset(options.estimateOffset),
      m_estimateDark(options.estimateDark && board.pattern == EPattern::chessboard &&
                     std::any_of(pairs.begin(), pairs.end(), [](const auto& pair) {
                         return pair.firstIsDark.has_value();
                     })) {}

bool CJointFit::isDark(std::size_t pair, const Eigen::Vector3d& p) const {
    const auto& first = m_pairs[pair].firstIsDark;
    if (!first || !m_estimateDark) return false;
    const auto cell = [&](double x) { return static_cast<int>(std::floor(x / m_square)); };
    return (std::abs(cell(p.x()) + cell(p.y())) % 2 == 0) == *first;
}

bool CJointFit::meetsDark(std::size_t pair, std::size_t beam, const TJointState& state) const {
    const double a = m_pairs[pair].scan.direction(beam);
    const TLaserPose pose = state.pose();
    const TPlane plane = state.plane(pair);
    const Eigen::Vector3d along = pose.R.col(0) * std::cos(a) + pose.R.col(1) * std::sin(a);
    const double range = -plane.offset(pose.t) / plane.normal.dot(along);
    return std::abs(range) < 1e3 && isDark(pair, state.onBoard(pair, pose.t + range * along));
}

void CJointFit::run(const TBeams& beams, TJointState& state) const {
    TProblem work(*this, beams, state);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-10;
    options.num_threads = 1;  // the order of a sum must not depend on the machine
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &work.problem, &summary);
    if (!summary.IsSolutionUsable())
        throw std::runtime_error("the fit of camera and laser does not converge");
    state = work.state;
}

std::optional<Eigen::Matrix<double, 8, 8>> CJointFit::covariance(const TBeams& beams,
                                                                 const TJointState& state) const {
    TProblem work(*this, beams, state);
    ceres::Covariance::Options options;
    options.num_threads = 1;
    ceres::Covariance covariance(options);
    const double* laser = work.state.laser.data();
    const std::vector<std::pair<const double*, const double*>> wanted{{laser, laser}};
    if (!covariance.Compute(wanted, &work.problem)) return std::nullopt;
    Eigen::Matrix<double, 8, 8, Eigen::RowMajor> block;
    if (!covariance.GetCovarianceBlock(laser, laser, block.data())) return std::nullopt;
    return Eigen::Matrix<double, 8, 8>(block);
}

double CJointFit::rangeResidual(std::size_t pair,
                                std::size_t beam,
                                const TJointState& state) const {
    const auto& scan = m_pairs[pair].scan;
    const TRangeCost cost{scan.direction(beam), scan.ranges[beam], meetsDark(pair, beam, state), 1};
    double residual = 0;
    const bool meets = cost(state.laser.data(), state.boards[pair].data(), &residual);
    return meets ? residual : std::numeric_limits<double>::infinity();
}

void CJointFit::estimateSigmas(const TBeams& beams, const TJointState& state) {
    std::vector<double> ranges, pixels;
    for (std::size_t i = 0; i < m_pairs.size(); ++i) {
        if (beams[i].empty()) continue;
        for (const std::size_t beam : beams[i])
            ranges.push_back(std::abs(rangeResidual(i, beam, state)));
        for (std::size_t k = 0; k < m_board.size(); ++k) {
            double residual[2] = {0, 0};
            const TCornerCost cost{m_camera, m_board[k], m_pairs[i].pixels[k], 1};
            if (!cost(state.boards[i].data(), residual)) continue;
            pixels.insert(pixels.end(), {std::abs(residual[0]), std::abs(residual[1])});
        }
    }
    if (ranges.empty() || pixels.empty()) return;
    // of a normal distribution; with a floor, so that pictures without noise do not divide by 0
    sigmaRange = std::max(1e-4, 1.4826 * medianOf(ranges));
    sigmaPixels = std::max(1e-3, 1.4826 * medianOf(pixels));
}

}  // namespace salma::calibration
