// SPDX-License-Identifier: BSD-3-Clause
// The step of MRPT's Kalman filter with salma's association: `update = mrpt`.
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <salma/slam/CSalientEKF2D.h>
#include <salma/slam/rangeBearingModel.h>

#include <stdexcept>

namespace salma::slam {

void CSalientEKF2D::stepByMrpt() {
    mrpt::obs::CActionRobotMovement2D movement;
    movement.poseChange = mrpt::poses::CPosePDF::Ptr(
        std::make_shared<mrpt::poses::CPosePDFGaussian>(m_now.input.increment));
    auto action = std::make_shared<mrpt::obs::CActionCollection>();
    action->insert(movement);
    // MRPT's models read the sensor's pose from it: the robot frame. Measurements come by the hook.
    auto frame = std::make_shared<mrpt::obs::CSensoryFrame>();
    frame->insert(std::make_shared<mrpt::obs::CObservationBearingRange>());
    processActionObservation(action, frame);
    if (!m_pkk.asEigen().allFinite()) throw std::runtime_error("Update by MRPT is not finite");
}

void CSalientEKF2D::OnTransitionModel(const KFArray_ACT& u, KFArray_VEH& pose, bool& skip) const {
    skip = false;
    const TMotion motion = moved({pose[0], pose[1], pose[2]}, {u[0], u[1], u[2]});
    for (int i = 0; i < 3; ++i) pose[i] = motion.pose[i];
}

// MRPT's own divides by zero for a landmark at right angles to the robot.
void CSalientEKF2D::OnObservationJacobians(size_t index, KFMatrix_OxV& Hx, KFMatrix_OxF& Hy) const {
    const TSighting expected =
        sighting(poseMean(), {m_xkk[3 + 2 * index], m_xkk[3 + 2 * index + 1]});
    Hx.asEigen() = expected.byPose;
    Hy.asEigen() = expected.byLandmark;
}

void CSalientEKF2D::OnGetObservationNoise(KFMatrix_OxO& R) const {
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    double count = 0;
    for (const auto& measurement : m_now.input.measurements) {
        if (!measurement.R.allFinite()) continue;  // clutter
        sum += measurement.R;
        ++count;
    }
    R.asEigen() = count > 0 ? Eigen::Matrix2d(sum / count) : Eigen::Matrix2d::Identity();
}

void CSalientEKF2D::OnPreComputingPredictions(const vector_KFArray_OBS& means,
                                              std::vector<size_t>& indices) const {
    indices.clear();
    for (std::size_t k = 0; k < means.size(); ++k)
        if (means[k][0] <= m_ekf.maxRange) indices.push_back(k);
}

void CSalientEKF2D::OnGetObservationsAndDataAssociation(vector_KFArray_OBS& z,
                                                        std::vector<int>& pairings,
                                                        const vector_KFArray_OBS& /*predictions*/,
                                                        const KFMatrix& /*S*/,
                                                        const std::vector<size_t>& /*indicesInS*/,
                                                        const KFMatrix_OxO& /*R*/) {
    // MRPT asks again if a paired landmark was not predicted: the answer must stay the same.
    if (!m_now.judgement) associate();
    z.clear();
    pairings.clear();
    m_now.rowToObservation.clear();
    for (std::size_t i = 0; i < m_now.decisions.size(); ++i) {
        const bool paired = m_now.decisions[i] == EDecision::paired;
        // Whatever MRPT gets either updates or makes a landmark: the rest is left out.
        if (!paired && m_now.decisions[i] != EDecision::created) continue;
        KFArray_OBS row;
        row[0] = m_now.input.measurements[i].z[0];
        row[1] = m_now.input.measurements[i].z[1];
        z.push_back(row);
        pairings.push_back(paired ? m_now.landmarks[i] : -1);
        m_now.rowToObservation.push_back(i);
    }
}

void CSalientEKF2D::OnNewLandmarkAddedToMap(const size_t row, const size_t index) {
    enterLandmark(m_now.rowToObservation[row], index);
}

}  // namespace salma::slam
