// SPDX-License-Identifier: BSD-3-Clause
#include "poseConsistency.h"

#include <mrpt/math/wrap2pi.h>
#include <salma/viz/CTrajectoryScore.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace salma::apps {
namespace {

using mrpt::poses::CPose2D;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// e' P^-1 e; nothing unless P is positive definite beyond rounding.
std::optional<double> neesOf(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance) {
    const Eigen::Vector3d sigma = covariance.diagonal().cwiseMax(0).cwiseSqrt();
    if (!(sigma.minCoeff() > 1e-9) || !covariance.allFinite()) return std::nullopt;
    // metres and radians are made comparable before anything is called singular
    const Eigen::DiagonalMatrix<double, 3> scale(sigma.cwiseInverse());
    const Eigen::Matrix3d correlation = scale * covariance * scale;
    const Eigen::LLT<Eigen::Matrix3d> root(correlation);
    if (root.info() != Eigen::Success || !(root.matrixLLT().diagonal().minCoeff() > 1e-6))
        return std::nullopt;
    return root.matrixL().solve(scale * error).squaredNorm();
}

}  // namespace

TPoseConsistency poseConsistency(const slam::TRunRecord& record,
                                 const viz::TTrajectory& truth,
                                 double maxGap) {
    TPoseConsistency result{kNone, 0, std::vector<double>(TPoseConsistency::kParts, kNone), kNone,
                            0};
    if (record.trajectory.empty()) return result;
    const double start = record.trajectory.front().time;
    const double length = std::max(1e-9, record.trajectory.back().time - start);
    std::optional<CPose2D> T_m_w;  // of the map's frame and the truth's
    double sum = 0, before = 0;
    for (const auto& row : record.trajectory) {
        CPose2D T_w_r;
        if (!viz::interpolate(truth, row.time, maxGap, T_w_r)) continue;
        if (!T_m_w) T_m_w = row.running + (CPose2D() - T_w_r);
        const CPose2D T_m_r = *T_m_w + T_w_r;
        const Eigen::Vector3d error(row.running.x() - T_m_r.x(), row.running.y() - T_m_r.y(),
                                    mrpt::math::wrapToPi(row.running.phi() - T_m_r.phi()));
        result.finalError = std::hypot(error.x(), error.y());
        result.maxJump = std::max(result.maxJump, result.finalError - before);
        before = result.finalError;
        const auto nees = neesOf(error, row.covariance);
        if (!nees) continue;
        sum += *nees;
        ++result.steps;
        const double share = (row.time - start) / length;
        const auto part = static_cast<std::size_t>(share * TPoseConsistency::kParts);
        result.at[std::min(part, TPoseConsistency::kParts - 1)] = *nees;
    }
    if (result.steps > 0) result.meanNees = sum / static_cast<double>(result.steps);
    return result;
}

}  // namespace salma::apps
