// SPDX-License-Identifier: BSD-3-Clause
// A step that odometry cannot explain, but a slip of the wheels can.
#include <salma/slam/CSalientEKF2D.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "slipProposals.h"

namespace salma::slam {

namespace {

constexpr double justUsed = 1;            // landmarks used within so much travel are tracked [m]
constexpr std::size_t leastExpected = 2;  // of them must be in view to say that something is wrong
constexpr double expectedInView = 0.4;    // probability of detection from which one is expected
constexpr double shortestStretch = 0.05;  // a slip may have been in the step before [m]
constexpr double leastLead = 5;           // over the second-best explanation [nats]

/// With the log probability that no landmark is measured, which scores are stated without.
double scoreOf(const association::TAssociationProblem& problem,
               const association::TAssociation& association) {
    double score = association.score;
    for (const auto& landmark : problem.landmarks)
        if (landmark.visible && landmark.detection)
            score += std::log1p(-landmark.detection->probability());
    return score;
}

Eigen::Vector2d directionOf(const mrpt::poses::CPose2D& motion) {
    return motion.norm() > 0 ? Eigen::Vector2d(motion.x(), motion.y()).normalized()
                             : Eigen::Vector2d(1, 0);
}

/// What a slip adds to the covariance of the increment, in the frame of the robot.
Eigen::Matrix3d covarianceOf(const TSlipOptions& slip, const Eigen::Vector2d& direction) {
    Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
    result.topLeftCorner<2, 2>() = slip.along * slip.along * direction * direction.transpose();
    result(2, 2) = slip.turn * slip.turn;
    return result;
}

}  // namespace

/// By landmark, whether it was just used.
std::vector<bool> CSalientEKF2D::tracked() const {
    std::vector<bool> result;
    for (std::size_t k = 0; k < m_landmarks.size(); ++k) {
        const auto used = m_lastUsed.find(m_landmarks[k].id);
        result.push_back(used != m_lastUsed.end() &&
                         used->second >= m_history.back().travel - justUsed);
    }
    return result;
}

/// Whether most of what was tracked and should be seen is not where it should be.
bool CSalientEKF2D::suspectsSlip(const TJudgement& judgement) const {
    if (m_history.empty()) return false;
    std::vector<bool> paired(m_landmarks.size(), false);
    for (const auto& decision : judgement.association.decisions)
        if (decision.landmark >= 0) paired[static_cast<std::size_t>(decision.landmark)] = true;
    const std::vector<bool> isTracked = tracked();
    std::size_t expected = 0, found = 0;
    for (std::size_t k = 0; k < m_landmarks.size(); ++k) {
        if (!isTracked[k] ||
            !(judgement.problem.landmarks[k].detection->probability() >= expectedInView))
            continue;
        ++expected;
        found += paired[k];
    }
    return expected >= leastExpected && 2 * found < expected;
}

/* Odometry errs by little at almost every step and by much at a few. Under the normal noise a slip
 * leaves all landmarks beside their measurements, and the map would be made a second time. How far
 * the robot really came is proposed by the landmarks themselves, since derivatives of before the
 * slip do not hold after it. */
void CSalientEKF2D::considerSlip() {
    const auto& motion = m_now.input.increment.mean;
    const double probability =
        std::min(0.5, m_care.slip.perMetre * std::max(motion.norm(), shortestStretch));
    const double prior = std::log(probability / (1 - probability));
    const Eigen::Vector2d direction = directionOf(motion);
    const Eigen::Matrix3d noise = covarianceOf(m_care.slip, direction);
    const Eigen::VectorXd mean = state().mean;
    const RowMatrix covariance = state().covariance;
    const auto slipBy = [&](double shift) {
        state().mean = mean;
        state().covariance = covariance;
        if (shift != 0) predict(state(), {shift * direction.x(), shift * direction.y(), 0}, noise);
    };
    const TJudgement& normal = *m_now.judgement;
    double best = scoreOf(normal.problem, normal.association), second = best;
    std::optional<TJudgement> winner;
    double winningShift = 0;
    for (const double shift :
         slipProposals(m_care.slip, normal.problem, tracked(), direction, leastExpected)) {
        slipBy(shift);
        TJudgement slipped = judged();
        const double score = scoreOf(slipped.problem, slipped.association) + prior -
                             0.5 * std::pow(shift / m_care.slip.along, 2);
        if (score > best && !suspectsSlip(slipped)) {
            second = best;
            best = score;
            winner = std::move(slipped);
            winningShift = shift;
        } else {
            second = std::max(second, score);
        }
    }
    if (!winner || best < second + leastLead) return slipBy(0);
    slipBy(winningShift);
    m_now.judgement = std::move(winner);
    m_now.motion.slip = {winningShift * direction.x(), winningShift * direction.y(), 0};
    m_now.input.increment.cov += mrpt::math::CMatrixDouble33(noise);
}

}  // namespace salma::slam
