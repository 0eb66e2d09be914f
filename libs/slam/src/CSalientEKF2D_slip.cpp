// SPDX-License-Identifier: BSD-3-Clause
// A step that odometry cannot explain, but a slip of the wheels can.
#include <salma/slam/CSalientEKF2D.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace salma::slam {

namespace {

constexpr double justUsed = 1;            // landmarks used within so much travel are tracked [m]
constexpr std::size_t leastExpected = 2;  // of them must be in view to say that something is wrong
constexpr double expectedInView = 0.4;    // probability of detection from which one is expected
constexpr double shortestStretch = 0.05;  // a slip may have been in the step before [m]
constexpr double largestSlip = 3;         // that is thought of [sigma]
constexpr double oneSlip = 0.08;          // pairs that propose it agree so well [m]
constexpr double leastLead = 5;           // over the second-best explanation [nats]
constexpr std::size_t slipsJudged = 3;

/// Log probability that none of the landmarks is measured, which scores are stated without.
double logUnseen(const association::TAssociationProblem& problem) {
    double sum = 0;
    for (const auto& landmark : problem.landmarks)
        if (landmark.visible && landmark.detection)
            sum += std::log1p(-landmark.detection->probability());
    return sum;
}

double scoreOf(const association::TAssociationProblem& problem,
               const association::TAssociation& association) {
    return association.score + logUnseen(problem);
}

Eigen::Vector2d pointOf(const Eigen::Vector2d& z) {
    return {z[0] * std::cos(z[1]), z[0] * std::sin(z[1])};
}

}  // namespace

bool CSalientEKF2D::isTracked(std::size_t landmark) const {
    const auto used = m_lastUsed.find(m_landmarks[landmark].id);
    return used != m_lastUsed.end() && used->second >= m_history.back().travel - justUsed;
}

/// Whether most of what was tracked and should be seen is not where it should be.
bool CSalientEKF2D::suspectsSlip(const TJudgement& judgement) const {
    if (m_history.empty()) return false;
    std::vector<bool> paired(m_landmarks.size(), false);
    for (const auto& decision : judgement.association.decisions)
        if (decision.landmark >= 0) paired[static_cast<std::size_t>(decision.landmark)] = true;
    std::size_t expected = 0, found = 0;
    for (std::size_t k = 0; k < m_landmarks.size(); ++k) {
        if (!isTracked(k) ||
            !(judgement.problem.landmarks[k].detection->probability() >= expectedInView))
            continue;
        ++expected;
        found += paired[k];
    }
    return expected >= leastExpected && 2 * found < expected;
}

/// Distances along the motion that would lay tracked landmarks onto measurements, the most
/// supported first [m].
std::vector<double> CSalientEKF2D::possibleSlips(const TJudgement& judgement) const {
    const Eigen::Vector2d direction = motionDirection();
    const Eigen::Vector2d across(-direction.y(), direction.x());
    std::vector<double> shifts;
    for (const auto& m : judgement.problem.measurements) {
        if (!m.z.allFinite()) continue;
        for (std::size_t k = 0; k < m_landmarks.size(); ++k) {
            const auto& landmark = judgement.problem.landmarks[k];
            if (!isTracked(k) || landmark.kind != m.kind || landmark.convex != m.convex) continue;
            const Eigen::Vector2d apart = pointOf(landmark.z) - pointOf(m.z);
            const double limit = oneSlip + m_care.slip.turn * landmark.z[0];
            if (std::abs(apart.dot(across)) <= limit &&
                std::abs(apart.dot(direction)) <= largestSlip * m_care.slip.along)
                shifts.push_back(apart.dot(direction));
        }
    }
    std::vector<std::pair<std::size_t, double>> proposals;
    for (const double shift : shifts) {
        double sum = 0;
        std::size_t count = 0;
        for (const double other : shifts)
            if (std::abs(other - shift) <= oneSlip) {
                sum += other;
                ++count;
            }
        proposals.emplace_back(count, sum / static_cast<double>(count));
    }
    std::stable_sort(proposals.begin(), proposals.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : std::abs(a.second) < std::abs(b.second);
    });
    std::vector<double> result;
    for (const auto& [count, shift] : proposals) {
        const bool isNew = std::none_of(result.begin(), result.end(), [s = shift](double other) {
            return std::abs(other - s) <= oneSlip;
        });
        if (isNew && count >= leastExpected && std::abs(shift) > oneSlip &&
            result.size() < slipsJudged)
            result.push_back(shift);
    }
    return result;
}

Eigen::Vector2d CSalientEKF2D::motionDirection() const {
    const auto& motion = m_now.input.increment.mean;
    return motion.norm() > 0 ? Eigen::Vector2d(motion.x(), motion.y()).normalized()
                             : Eigen::Vector2d(1, 0);
}

/// What a slip adds to the covariance of the increment, in the frame of the robot.
Eigen::Matrix3d CSalientEKF2D::slipCovariance() const {
    const Eigen::Vector2d direction = motionDirection();
    const TSlipOptions& slip = m_care.slip;
    Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
    result.topLeftCorner<2, 2>() = slip.along * slip.along * direction * direction.transpose();
    result(2, 2) = slip.turn * slip.turn;
    return result;
}

/* Odometry errs by little at almost every step and by much at a few. Under the normal noise a slip
 * leaves all landmarks beside their measurements, and the map would be made a second time. How far
 * the robot really came is proposed by the landmarks themselves, since derivatives of before the
 * slip do not hold after it. */
void CSalientEKF2D::considerSlip() {
    const double stretch = std::max(m_now.input.increment.mean.norm(), shortestStretch);
    const double probability = std::min(0.5, m_care.slip.perMetre * stretch);
    const double prior = std::log(probability / (1 - probability));
    const Eigen::Matrix3d slip = slipCovariance();
    const Eigen::Vector2d direction = motionDirection();
    const Eigen::VectorXd mean = state().mean;
    const RowMatrix covariance = state().covariance;
    const auto& normal = *m_now.judgement;
    double best = scoreOf(normal.problem, normal.association), second = best;
    std::optional<TJudgement> winner;
    double winningShift = 0;
    for (const double shift : possibleSlips(normal)) {
        state().mean = mean;
        state().covariance = covariance;
        predict(state(), {shift * direction.x(), shift * direction.y(), 0}, slip);
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
    state().mean = mean;
    state().covariance = covariance;
    if (!winner || best < second + leastLead) return;

    predict(state(), {winningShift * direction.x(), winningShift * direction.y(), 0}, slip);
    m_now.judgement = std::move(winner);
    m_now.motion.slip = {winningShift * direction.x(), winningShift * direction.y(), 0};
    m_now.input.increment.cov += mrpt::math::CMatrixDouble33(slip);
}

}  // namespace salma::slam
