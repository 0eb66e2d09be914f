// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves behind.
#include <mrpt/core/bits_math.h>
#include <salma/association/CJointInnovation.h>
#include <salma/slam/CSalientEKF2D.h>

#include <algorithm>
#include <cmath>

namespace salma::slam {

void CSalientEKF2D::noteAssociation(const association::TAssociationProblem& problem) {
    const double time = m_now.input.time;
    for (const auto& candidate : m_now.association->candidates)
        m_record.candidates.push_back({time, candidate.observation,
                                       m_landmarks[candidate.landmark].id, candidate.distance2,
                                       candidate.logRatio, candidate.chosen});
    for (std::size_t i = 0; i < problem.measurements.size(); ++i) {
        const int landmark = m_now.association->decisions[i].landmark;
        if (landmark < 0) continue;
        const auto& m = problem.measurements[i];
        const Eigen::Vector2d nu =
            association::innovation(m.z, problem.landmarks[static_cast<std::size_t>(landmark)].z);
        const Eigen::Vector2d sigma =
            (problem.predictionCovariance.diagonal().segment<2>(2 * landmark) + m.R.diagonal())
                .cwiseSqrt();
        m_record.innovations.push_back({time, "range_m", nu[0], sigma[0]});
        m_record.innovations.push_back(
            {time, "bearing_deg", mrpt::RAD2DEG(nu[1]), mrpt::RAD2DEG(sigma[1])});
    }
}

void CSalientEKF2D::noteDecisions() {
    for (std::size_t i = 0; i < m_now.decisions.size(); ++i) {
        const auto& decision = m_now.association->decisions[i];
        const auto& measurement = m_now.input.measurements[i];
        TAssociationRow row;
        row.time = m_now.input.time;
        row.observation = i;
        row.kind = measurement.kind;
        row.range = measurement.z[0];
        row.bearing = measurement.z[1];
        const TSpot spot = m_now.input.spots.empty() ? TSpot() : m_now.input.spots[i];
        row.u = spot.pixel.x;
        row.v = spot.pixel.y;
        row.axisAngle = spot.axisAngle;
        row.decision = m_now.decisions[i];
        if (m_now.landmarks[i] >= 0)
            row.landmark = m_landmarks[static_cast<std::size_t>(m_now.landmarks[i])].id;
        row.distance2 = decision.distance2;
        row.logRatio = decision.logRatio;
        row.candidates = decision.candidates;
        m_record.associations.push_back(row);
    }
}

void CSalientEKF2D::notePose() {
    const auto had = [this](EDecision decision) {
        return std::count(m_now.decisions.begin(), m_now.decisions.end(), decision) > 0;
    };
    const mrpt::poses::CPosePDFGaussian estimate = pose();
    TTrajectoryRow row;
    row.time = m_now.input.time;
    row.pose = estimate.mean;
    row.covariance = estimate.cov.asEigen();
    row.odometry = m_now.input.odometry;
    row.sight = had(EDecision::paired)    ? ESight::again
                : had(EDecision::created) ? ESight::first
                                          : ESight::nothing;
    m_record.trajectory.push_back(row);
}

void CSalientEKF2D::results(TRunRecord& record) const {
    record.trajectory = m_record.trajectory;
    record.associations = m_record.associations;
    record.candidates = m_record.candidates;
    record.innovations = m_record.innovations;
    record.landmarks.clear();
    for (std::size_t k = 0; k < m_landmarks.size(); ++k) {
        const TLandmark& known = m_landmarks[k];
        const auto row = static_cast<Eigen::Index>(3 + 2 * k);
        TMapLandmark landmark;
        landmark.id = known.id;
        landmark.kind = known.kind;
        landmark.mean = {m_xkk[row], m_xkk[row + 1]};
        landmark.covariance = m_pkk.asEigen().block<2, 2>(row, row);
        landmark.firstMean = known.firstMean;
        landmark.firstCovariance = known.firstCovariance;
        landmark.sightings = known.sightings;
        landmark.firstTime = known.firstTime;
        landmark.lastTime = known.lastTime;
        landmark.wallAngle = known.firstWallAngle;
        const auto frontal = std::min_element(
            known.views.begin(), known.views.end(),
            [](const TView& a, const TView& b) { return std::abs(a.angle) < std::abs(b.angle); });
        if (frontal != known.views.end()) landmark.patch = frontal->patch;
        record.landmarks.push_back(landmark);
    }
}

}  // namespace salma::slam
