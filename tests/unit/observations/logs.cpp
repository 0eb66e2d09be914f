// SPDX-License-Identifier: BSD-3-Clause
#include "logs.h"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/random/RandomGenerators.h>

using namespace mrpt::obs;
using mrpt::poses::CPose2D;

namespace salma::test {
namespace {

template <class OBSERVATION>
typename OBSERVATION::Ptr stamped(double time, const std::string& label) {
    auto observation = OBSERVATION::Create();
    observation->timestamp = mrpt::Clock::fromDouble(kStart + time);
    observation->sensorLabel = label;
    return observation;
}

CActionRobotMovement2D::TMotionModelOptions thrunOptions(unsigned particles) {
    CActionRobotMovement2D::TMotionModelOptions options;
    options.modelSelection = CActionRobotMovement2D::mmThrun;
    options.thrunModel.nParticlesCount = particles;
    return options;
}

CActionCollection::Ptr collection(const CAction& action) {
    auto actions = CActionCollection::Create();
    actions->insert(action);
    return actions;
}

}  // namespace

CObservation2DRangeScan::Ptr scanAt(double time, const std::string& label) {
    auto scan = stamped<CObservation2DRangeScan>(time, label);
    scan->resizeScanAndAssign(11, 3.0F, true);
    return scan;
}

CObservationOdometry::Ptr odometryAt(double time, const CPose2D& pose) {
    auto record = stamped<CObservationOdometry>(time, "ODOMETRY");
    record->odometry = pose;
    return record;
}

CObservationBearingRange::Ptr bearings(std::size_t count, bool ownCovariances) {
    auto sightings = stamped<CObservationBearingRange>(0, "LANDMARKS");
    sightings->sensedData.resize(count);
    sightings->validCovariances = ownCovariances;
    for (auto& sighting : sightings->sensedData) {
        sighting.range = 1;
        sighting.landmarkID = mrpt::obs::INVALID_LANDMARK_ID;
        sighting.covariance.setIdentity();
    }
    return sightings;
}

CObservationImage::Ptr pictureAt(double time, const std::string& file) {
    auto picture = stamped<CObservationImage>(time, "CAMERA");
    picture->image.setExternalStorage(file);
    return picture;
}

observations::CObservationSalientLandmarks::Ptr recordAt(double time) {
    auto record = stamped<observations::CObservationSalientLandmarks>(time, "SALIENT");
    record->landmarks.resize(1);
    record->landmarks[0].width = time;
    return record;
}

observations::CObservationPanTilt::Ptr headAt(double time, double pan) {
    auto state = stamped<observations::CObservationPanTilt>(time, "HEAD");
    state->pan = pan;
    return state;
}

CSensoryFrame::Ptr frame(const std::vector<CObservation::Ptr>& observations) {
    auto result = CSensoryFrame::Create();
    for (const auto& observation : observations) result->insert(observation);
    return result;
}

CActionCollection::Ptr motion(const CPose2D& increment) {
    CActionRobotMovement2D action;
    action.computeFromOdometry(increment, CActionRobotMovement2D::TMotionModelOptions());
    return collection(action);
}

CActionCollection::Ptr thrunMotion(const CPose2D& increment) {
    CActionRobotMovement2D action;
    action.computeFromOdometry(increment, thrunOptions(50));
    return collection(action);
}

mrpt::math::CMatrixDouble33 thrunCovariance(const CPose2D& increment, unsigned particles) {
    mrpt::random::getRandomGenerator().randomize(7);
    CActionRobotMovement2D action;
    action.computeFromOdometry(increment, thrunOptions(particles));
    return action.poseChange->getCovariance();
}

CActionCollection::Ptr motion3D(const mrpt::poses::CPose3D& increment, double variance) {
    CActionRobotMovement3D action;
    action.poseChange.mean = increment;
    action.poseChange.cov.setZero();
    for (int i = 0; i < 6; ++i) action.poseChange.cov(i, i) = variance;
    return collection(action);
}

CActionCollection::Ptr noMotion() { return CActionCollection::Create(); }

}  // namespace salma::test
