// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DQuat.h>
#include <salma/association/CJointInnovation.h>
#include <salma/slam/CSalientEKF3D.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "recordRows.h"

namespace salma::slam {

using association::EVerdict;
using association::TMeasurement3D;

namespace {

constexpr Eigen::Index kPose = 7;

Eigen::Index rowOf(std::size_t landmark) { return kPose + 3 * static_cast<Eigen::Index>(landmark); }

/// Rows (x, y, yaw) of a covariance of (x, y, z, yaw, pitch, roll).
Eigen::Matrix3d planar(const mrpt::math::CMatrixDouble66& covariance) {
    constexpr int kRows[] = {0, 1, 3};
    Eigen::Matrix3d result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result(i, j) = covariance(kRows[i], kRows[j]);
    return result;
}

void checkSpatial(const TStepInput& step) {
    if (!step.spatial)
        throw std::invalid_argument("A step of a filter in space has no such motion");
    const auto& increment = step.spatial->increment;
    if (!std::isfinite(step.time) || !increment.mean.asVectorVal().asEigen().allFinite() ||
        !increment.cov.asEigen().allFinite())
        throw std::invalid_argument("Odometry of a step is not finite");
}

association::TMeasurement flat(const TMeasurement3D& measurement) {
    association::TMeasurement result;
    result.z = measurement.z.head<2>();
    result.R = measurement.R.topLeftCorner<2, 2>();
    result.identity = measurement.identity;
    return result;
}

}  // namespace

CSalientEKF3D::CSalientEKF3D(const TEkfOptions& ekf,
                             const association::TAssociationOptions& association)
    : m_ekf(ekf),
      m_associator(association::createAssociator(association)),
      m_landmarks(ekf.maxPatches, ekf.patchSpread) {
    m_ekf.validate();
}

CSalientEKF3D::~CSalientEKF3D() = default;

const std::vector<TMeasurement3D>& CSalientEKF3D::measurements() const {
    return m_now.input.spatial->measurements;
}

mrpt::poses::CPose3DPDFGaussian CSalientEKF3D::spatialPose() const {
    mrpt::poses::CPose3DPDFGaussian result;
    getCurrentRobotPose(result);
    return result;
}

mrpt::poses::CPosePDFGaussian CSalientEKF3D::pose() const {
    const auto spatial = spatialPose();
    return {mrpt::poses::CPose2D(spatial.mean), mrpt::math::CMatrixDouble33(planar(spatial.cov))};
}

void CSalientEKF3D::process(const TStepInput& step) {
    checkSpatial(step);
    m_now = {};
    m_now.input = step;
    m_now.input.measurements.clear();
    m_now.input.spots.clear();
    for (TMeasurement3D& measurement : m_now.input.spatial->measurements) {
        if (m_ekf.ignoreIdentities) measurement.identity.reset();
        m_now.input.measurements.push_back(flat(measurement));
    }
    mrpt::obs::CActionRobotMovement3D movement;
    movement.poseChange = step.spatial->increment;
    auto action = std::make_shared<mrpt::obs::CActionCollection>();
    action->insert(movement);
    // MRPT's models read the sensor's pose from it; the measurements come by the hook.
    auto record = std::make_shared<mrpt::obs::CObservationBearingRange>();
    record->setSensorPose(step.spatial->sensor);
    auto frame = std::make_shared<mrpt::obs::CSensoryFrame>();
    frame->insert(record);
    processActionObservation(action, frame);
    if (!m_pkk.asEigen().allFinite()) throw std::runtime_error("Update by MRPT is not finite");
    learn();
    noteStep();
}

// MRPT's own stands still while there is no landmark.
void CSalientEKF3D::OnTransitionModel(const KFArray_ACT& u, KFArray_VEH& pose, bool& skip) const {
    skip = false;
    const auto asPose = [](const auto& v) {
        return mrpt::poses::CPose3DQuat(v[0], v[1], v[2],
                                        mrpt::math::CQuaternionDouble(v[3], v[4], v[5], v[6]));
    };
    const mrpt::poses::CPose3DQuat moved = asPose(pose) + asPose(u);
    for (int i = 0; i < kPose; ++i) pose[i] = moved[i];
}

void CSalientEKF3D::OnGetObservationNoise(KFMatrix_OxO& R) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double count = 0;
    for (const TMeasurement3D& measurement : measurements()) {
        if (!measurement.R.allFinite()) continue;  // clutter
        sum += measurement.R;
        ++count;
    }
    R.asEigen() = count > 0 ? Eigen::Matrix3d(sum / count) : Eigen::Matrix3d::Identity();
}

// All of them: one of a known identity may lie beyond the reach that is stated.
void CSalientEKF3D::OnPreComputingPredictions(const vector_KFArray_OBS& means,
                                              std::vector<size_t>& indices) const {
    indices.resize(means.size());
    for (std::size_t k = 0; k < means.size(); ++k) indices[k] = k;
}

void CSalientEKF3D::associate(const vector_KFArray_OBS& predictions,
                              const KFMatrix& S,
                              const std::vector<size_t>& indicesInS,
                              const KFMatrix_OxO& R) {
    association::TAssociationProblem3D problem;
    problem.measurements = measurements();
    problem.predictionCovariance = S.asEigen();
    const THeading heading{0, 0};  // only walls are compared with it
    for (std::size_t k = 0; k < indicesInS.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(3 * k);
        problem.predictionCovariance.block<3, 3>(row, row) -= R.asEigen();
        association::TPredictedLandmark3D landmark;
        landmark.identity = m_landmarks.expected(indicesInS[k], heading).identity;
        for (int i = 0; i < 3; ++i) landmark.z[i] = predictions[indicesInS[k]][i];
        // What lies at the border of view may be seen: three sigma are granted.
        const Eigen::Vector3d slack =
            3 * problem.predictionCovariance.diagonal().segment<3>(row).cwiseMax(0).cwiseSqrt();
        landmark.visible = landmark.z[0] <= m_ekf.maxRange + slack[0] &&
                           std::abs(landmark.z[1]) <= m_ekf.fieldOfView / 2 + slack[1];
        problem.landmarks.push_back(landmark);
    }
    m_now.association = m_associator->associate(problem);
    for (auto& decision : m_now.association->decisions) {
        if (decision.landmark >= 0)
            decision.landmark =
                static_cast<int>(indicesInS[static_cast<std::size_t>(decision.landmark)]);
        m_now.landmarks.push_back(decision.landmark);
    }
    for (auto& candidate : m_now.association->candidates)
        candidate.landmark = indicesInS[candidate.landmark];
    noteInnovations(problem);
}

void CSalientEKF3D::OnGetObservationsAndDataAssociation(vector_KFArray_OBS& z,
                                                        std::vector<int>& pairings,
                                                        const vector_KFArray_OBS& predictions,
                                                        const KFMatrix& S,
                                                        const std::vector<size_t>& indicesInS,
                                                        const KFMatrix_OxO& R) {
    // MRPT may ask again: the answer must stay the same.
    if (!m_now.association) associate(predictions, S, indicesInS, R);
    z.clear();
    pairings.clear();
    m_now.rowToObservation.clear();
    for (std::size_t i = 0; i < measurements().size(); ++i) {
        const EVerdict verdict = m_now.association->decisions[i].verdict;
        // Whatever MRPT gets either updates or makes a landmark: the rest is left out.
        if (verdict != EVerdict::paired && verdict != EVerdict::created) continue;
        KFArray_OBS row;
        for (int k = 0; k < 3; ++k) row[k] = measurements()[i].z[k];
        z.push_back(row);
        pairings.push_back(verdict == EVerdict::paired ? m_now.landmarks[i] : -1);
        m_now.rowToObservation.push_back(i);
    }
}

void CSalientEKF3D::OnNewLandmarkAddedToMap(const size_t row, const size_t index) {
    const std::size_t observation = m_now.rowToObservation[row];
    const int id = m_landmarks.add(m_now.input.measurements[observation], m_now.input.time);
    m_IDs.insert(id, static_cast<unsigned>(index));
    m_now.landmarks[observation] = static_cast<int>(index);
}

void CSalientEKF3D::learn() {
    for (std::size_t i = 0; i < m_now.landmarks.size(); ++i) {
        if (m_now.landmarks[i] < 0) continue;
        const auto index = static_cast<std::size_t>(m_now.landmarks[i]);
        m_landmarks.sight(index, m_now.input.measurements[i], m_now.input.time, {0, 0});
        if (m_now.association->decisions[i].verdict != EVerdict::created) continue;
        const Eigen::Index row = rowOf(index);
        m_landmarks.setFirst(index, {m_xkk[row], m_xkk[row + 1]},
                             m_pkk.asEigen().block<2, 2>(row, row));
    }
}

void CSalientEKF3D::noteInnovations(const association::TAssociationProblem3D& problem) {
    for (std::size_t i = 0; i < problem.measurements.size(); ++i) {
        if (m_now.landmarks[i] < 0) continue;
        const auto k = static_cast<std::size_t>(m_now.landmarks[i]);  // all are predicted
        const auto& m = problem.measurements[i];
        const Eigen::Vector3d nu = association::innovation(m.z, problem.landmarks[k].z);
        const Eigen::Vector3d sigma =
            (problem.predictionCovariance.diagonal().segment<3>(3 * static_cast<Eigen::Index>(k)) +
             m.R.diagonal())
                .cwiseSqrt();
        addInnovation(m_now.input.time, nu.head<2>(), sigma.head<2>(), m_record.innovations);
        m_record.innovations.push_back(
            {m_now.input.time, "pitch_deg", mrpt::RAD2DEG(nu[2]), mrpt::RAD2DEG(sigma[2])});
    }
}

void CSalientEKF3D::noteStep() {
    const double time = m_now.input.time;
    TTrajectoryRow row;
    for (std::size_t i = 0; i < m_now.landmarks.size(); ++i) {
        const auto& details = m_now.association->decisions[i];
        const EDecision decision = decisionOf(details.verdict);
        const int index = m_now.landmarks[i];
        const int id = index < 0 ? -1 : m_landmarks[static_cast<std::size_t>(index)].id;
        m_record.associations.push_back(associationRow(m_now.input, i, decision, details, id));
        if (decision == EDecision::paired) row.sight = ESight::again;
        if (decision == EDecision::created && row.sight == ESight::nothing)
            row.sight = ESight::first;
    }
    if (m_now.association)
        for (const auto& candidate : m_now.association->candidates)
            m_record.candidates.push_back({time, candidate.observation,
                                           m_landmarks[candidate.landmark].id, candidate.distance2,
                                           candidate.logRatio, candidate.chosen, candidate.inGate});
    const auto flatPose = pose();
    row.time = time;
    row.pose = row.running = flatPose.mean;
    row.covariance = flatPose.cov.asEigen();
    row.odometry = m_now.input.odometry;
    row.spatial = spatialPose().mean;
    m_record.trajectory.push_back(row);
}

void CSalientEKF3D::results(TRunRecord& record) const {
    record.trajectory = m_record.trajectory;
    record.associations = m_record.associations;
    record.candidates = m_record.candidates;
    record.innovations = m_record.innovations;
    record.landmarks.clear();
    for (std::size_t k = 0; k < m_landmarks.size(); ++k) {
        const Eigen::Index row = rowOf(k);
        TMapLandmark landmark = mapLandmarkOf(m_landmarks[k]);
        landmark.mean = {m_xkk[row], m_xkk[row + 1]};
        landmark.covariance = m_pkk.asEigen().block<2, 2>(row, row);
        landmark.z = m_xkk[row + 2];
        landmark.sigmaZ = std::sqrt(m_pkk(row + 2, row + 2));
        record.landmarks.push_back(landmark);
    }
}

}  // namespace salma::slam
