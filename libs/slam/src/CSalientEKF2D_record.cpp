// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves behind.
#include <salma/association/CJointInnovation.h>
#include <salma/slam/CSalientEKF2D.h>

#include <algorithm>

#include "recordRows.h"

namespace salma::slam {

void CSalientEKF2D::noteAssociation() {
    const TJudgement& judgement = *m_now.judgement;
    const association::TAssociationProblem& problem = judgement.problem;
    const double time = m_now.input.time;
    for (const auto& candidate : judgement.association.candidates)
        m_record.candidates.push_back({time, candidate.observation,
                                       m_landmarks[candidate.landmark].id, candidate.distance2,
                                       candidate.logRatio, candidate.chosen, candidate.inGate});
    for (std::size_t i = 0; i < problem.measurements.size(); ++i) {
        const int landmark = judgement.association.decisions[i].landmark;
        if (landmark < 0) continue;
        const auto& m = problem.measurements[i];
        const Eigen::Vector2d nu =
            association::innovation(m.z, problem.landmarks[static_cast<std::size_t>(landmark)].z);
        const Eigen::Vector2d sigma =
            (problem.predictionCovariance.diagonal().segment<2>(2 * landmark) + m.R.diagonal())
                .cwiseSqrt();
        addInnovation(time, nu, sigma, m_record.innovations);
    }
}

void CSalientEKF2D::noteDecisions() {
    for (std::size_t i = 0; i < m_now.decisions.size(); ++i) {
        const int index = m_now.landmarks[i];
        const EDecision decision = told(i);
        const int id = index < 0 || decision == EDecision::provisional
                           ? -1
                           : m_landmarks[static_cast<std::size_t>(index)].id;
        m_record.associations.push_back(associationRow(
            m_now.input, i, decision, m_now.judgement->association.decisions[i], id));
    }
}

void CSalientEKF2D::notePose() {
    const auto had = [this](EDecision decision) {
        return std::count(m_now.decisions.begin(), m_now.decisions.end(), decision) > 0;
    };
    const mrpt::poses::CPosePDFGaussian estimate = pose();
    TTrajectoryRow row;
    row.time = m_now.input.time;
    row.pose = row.running = estimate.mean;
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
    record.relocations = m_record.relocations;
    record.joins = m_record.joins;
    record.removed = m_record.removed;
    record.smoothed = m_record.smoothed;
    record.landmarks.clear();
    for (std::size_t k = 0; k < m_landmarks.size(); ++k) {
        if (!m_landmarks[k].confirmed) continue;
        const auto row = static_cast<Eigen::Index>(3 + 2 * k);
        TMapLandmark landmark = mapLandmarkOf(m_landmarks[k]);
        landmark.mean = {m_xkk[row], m_xkk[row + 1]};
        landmark.covariance = m_pkk.asEigen().block<2, 2>(row, row);
        record.landmarks.push_back(landmark);
    }
}

}  // namespace salma::slam
