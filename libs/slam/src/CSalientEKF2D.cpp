// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/CSalientEKF2D.h>
#include <salma/slam/rangeBearingModel.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "recordRows.h"

namespace salma::slam {

using association::ELandmarkKind;
using association::TAssociationProblem;
using association::TMeasurement;

namespace {

constexpr double smoothingTravel = 2;  // between two estimations of the whole path [m]

/// Corners have neither wall nor appearance and look the same from every side.
landmarks::TTrackingOptions cornerTracking(const TEkfOptions& ekf) {
    landmarks::TTrackingOptions options;
    options.minViews = ekf.minSightingsCorner;
    options.minSpread = options.minTravel = 0;
    options.across = ekf.provisionalRadius;
    options.memory = ekf.provisionalSteps;
    return options;
}

}  // namespace

CSalientEKF2D::CSalientEKF2D(const TEkfOptions& ekf,
                             const association::TAssociationOptions& association,
                             PatchRatio ratio,
                             const landmarks::TTrackingOptions& tracking,
                             const TMapCare& care)
    : m_ekf(ekf),
      m_associator(association::createAssociator(association)),
      m_ratio(std::move(ratio)),
      m_evidenceLimits{ekf.decorrelation, ekf.trackGap, association.forbidLogLr,
                       association.gateQuantile},
      m_landmarks(ekf.maxPatches, ekf.patchSpread),
      m_provisionalCorners(cornerTracking(ekf)),
      m_provisionalEntities(tracking, m_ratio),
      m_care(care),
      m_detection(care.detection,
                  {ekf.maxRange, ekf.fieldOfView / 2, association.detectionProbability}),
      m_relocates(care.relocation.use && ekf.update == EUpdate::block &&
                  association.method == association::EMethod::saliency),
      m_explainsSlips(care.slip.use && ekf.update == EUpdate::block &&
                      association.method == association::EMethod::saliency),
      m_relocator(care.relocation, care.detection) {
    m_ekf.validate();
}

CSalientEKF2D::~CSalientEKF2D() = default;

landmarks::TTrackingOptions CSalientEKF2D::atFirstSight() {
    landmarks::TTrackingOptions options;
    options.minViews = 1;
    options.minSpread = 0;
    return options;
}

TFilterState CSalientEKF2D::state() {
    const Eigen::Index size = m_xkk.size();
    return {Eigen::Map<Eigen::VectorXd>(&m_xkk[0], size),
            Eigen::Map<RowMatrix>(&m_pkk(0, 0), size, size)};
}

Eigen::Vector3d CSalientEKF2D::poseMean() const { return {m_xkk[0], m_xkk[1], m_xkk[2]}; }

THeading CSalientEKF2D::heading() const { return {m_xkk[2], std::sqrt(poseCovariance()(2, 2))}; }

mrpt::poses::CPosePDFGaussian CSalientEKF2D::pose() const {
    mrpt::poses::CPosePDFGaussian result;
    getCurrentRobotPose(result);
    result.cov = mrpt::math::CMatrixDouble33(poseCovariance());
    return result;
}

void CSalientEKF2D::process(const TStepInput& step) {
    checkStep(step);
    m_now = {};
    m_now.input = step;
    if (m_ekf.ignoreIdentities)
        for (TMeasurement& measurement : m_now.input.measurements) measurement.identity.reset();
    const mrpt::poses::CPose2D before(m_xkk[0], m_xkk[1], m_xkk[2]);
    if (m_ekf.update == EUpdate::block)
        stepByBlock();
    else
        stepByMrpt();
    m_now.motion.motion = mrpt::poses::CPose2D(m_xkk[0], m_xkk[1], m_xkk[2]) - before;
    m_now.motion.isKnown = m_explainsSlips && tracksLandmarks();
    learn();
    if (keepsHistory()) remember();
    if (m_relocates) {
        removeAbsent();
        relocate();
        if (m_now.closesLoop && m_history.back().travel >= m_lastSmoothing + smoothingTravel)
            smooth();
        anchor();
    }
    noteDecisions();
    notePose();
}

void CSalientEKF2D::stepByBlock() {
    const auto& increment = m_now.input.increment;
    predict(state(), {increment.mean.x(), increment.mean.y(), increment.mean.phi()},
            increment.cov.asEigen());
    associate();
    std::vector<TPairedMeasurement> paired;
    const auto& measurements = m_now.input.measurements;
    for (std::size_t i = 0; i < measurements.size(); ++i)
        if (m_now.decisions[i] == EDecision::paired)
            paired.push_back({static_cast<std::size_t>(m_now.landmarks[i]), measurements[i].z,
                              measurements[i].R});
    update(state(), paired);
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        if (m_now.decisions[i] != EDecision::created) continue;
        const std::size_t index = m_landmarks.size();
        m_xkk.resize(m_xkk.size() + 2);
        m_pkk.setSize(m_xkk.size(), m_xkk.size());
        initializeLast(state(), measurements[i].z, measurements[i].R);
        enterLandmark(i, index);
    }
}

/// Whether this step's place is told by landmarks: by two, so that a wrong one does not go unseen.
bool CSalientEKF2D::tracksLandmarks() const {
    return std::count(m_now.decisions.begin(), m_now.decisions.end(), EDecision::paired) >= 2;
}

void CSalientEKF2D::enterLandmark(std::size_t observation, std::size_t index) {
    const int id = m_landmarks.add(m_now.input.measurements[observation], m_now.input.time);
    m_IDs.insert(id, static_cast<unsigned>(index));
    m_now.landmarks[observation] = static_cast<int>(index);
}

CSalientEKF2D::TJudgement CSalientEKF2D::judged() const {
    const auto size = static_cast<Eigen::Index>(m_xkk.size());
    const Eigen::Map<const Eigen::VectorXd> mean(&m_xkk[0], size);
    const Eigen::Map<const RowMatrix> covariance(&m_pkk(0, 0), size, size);
    TJudgement result;
    TAssociationProblem& problem = result.problem;
    problem.measurements = m_now.input.measurements;
    problem.predictionCovariance = predictionCovariance(mean, covariance);
    const double halfView = m_ekf.fieldOfView / 2;
    const bool hasPoster = m_landmarks.hasPoster();
    for (std::size_t k = 0; k < m_landmarks.size(); ++k) {
        association::TPredictedLandmark expected = m_landmarks.expected(k, heading());
        const auto row = static_cast<Eigen::Index>(2 * k);
        expected.z = sighting(mean.head<3>(), mean.segment<2>(3 + row)).z;
        // What lies at the border of view may be seen: three sigma are granted.
        const Eigen::Vector2d slack =
            3 * problem.predictionCovariance.diagonal().segment<2>(row).cwiseSqrt();
        const double sigma = std::max(slack[0], expected.z[0] * slack[1]) / 3;
        result.sigmas.push_back(sigma);
        expected.visible = sigma <= largestSigma(k, hasPoster) &&
                           expected.z[0] <= m_ekf.maxRange + slack[0] &&
                           std::abs(expected.z[1]) <= halfView + slack[1];
        problem.landmarks.push_back(expected);
    }
    m_detection.state(m_now.input, problem);
    if (m_ratio) {
        result.evidence = std::make_unique<CStepEvidence>(m_evidenceLimits, m_landmarks, m_ratio,
                                                          problem, m_now.input.time);
        problem.logRatio = [evidence = result.evidence.get()](std::size_t i, std::size_t k) {
            return evidence->logRatio(i, k);
        };
    }
    result.association = m_associator->associate(problem);
    return result;
}

void CSalientEKF2D::associate() {
    m_now.judgement = judged();
    if (m_explainsSlips && suspectsSlip(*m_now.judgement)) considerSlip();
    const association::TAssociation& association = m_now.judgement->association;
    m_dropped += association.dropped;
    for (const auto& decision : association.decisions) {
        m_now.landmarks.push_back(decision.landmark);
        m_now.decisions.push_back(decisionOf(decision.verdict));
    }
    m_now.confirms.assign(m_now.decisions.size(), false);
    holdBackCorners();
    holdBackEntities();
    noteAssociation();
}

bool CSalientEKF2D::sees(ELandmarkKind kind) const {
    const auto& all = m_now.input.measurements;
    return std::any_of(all.begin(), all.end(), [kind](const auto& m) { return m.kind == kind; });
}

/// Corners that people and clutter make are many: they do not enter the state before they stayed.
void CSalientEKF2D::holdBackCorners() {
    if (!sees(ELandmarkKind::corner)) return;
    m_provisionalCorners.beginStep();
    for (std::size_t i = 0; i < m_now.decisions.size(); ++i) {
        const TMeasurement& m = m_now.input.measurements[i];
        if (m_now.decisions[i] != EDecision::created || m.identity ||
            m.kind != ELandmarkKind::corner)
            continue;
        if (!m_provisionalCorners.confirms(sightingOf(m)))
            m_now.decisions[i] = EDecision::provisional;
    }
}

/* Posters are few, and between two rows of doors they are all that tells how far the robot has
 * come: the state takes them at their first sighting, and they wait there to be told. The step of
 * MRPT's filter has them wait outside. */
void CSalientEKF2D::holdBackEntities() {
    if (!sees(ELandmarkKind::salient)) return;
    m_provisionalEntities.beginStep();
    for (std::size_t i = 0; i < m_now.decisions.size(); ++i) {
        const TMeasurement& m = m_now.input.measurements[i];
        if (m.identity || m.kind != ELandmarkKind::salient) continue;
        const bool isNew = m_now.decisions[i] == EDecision::created;
        const bool isOpen = m_now.decisions[i] == EDecision::paired &&
                            !m_landmarks[static_cast<std::size_t>(m_now.landmarks[i])].confirmed;
        if (!isNew && !isOpen) continue;
        m_now.confirms[i] = m_provisionalEntities.confirms(sightingOf(m));
        if (isNew && !m_now.confirms[i] && m_ekf.update == EUpdate::mrpt)
            m_now.decisions[i] = EDecision::provisional;
    }
}

/// What the record says of a measurement: what is not confirmed is provisional.
EDecision CSalientEKF2D::told(std::size_t observation) const {
    const EDecision decision = m_now.decisions[observation];
    if (decision != EDecision::created && decision != EDecision::paired) return decision;
    const auto index = static_cast<std::size_t>(m_now.landmarks[observation]);
    if (!m_landmarks[index].confirmed) return EDecision::provisional;
    return m_now.confirms[observation] ? EDecision::created : decision;
}

/// In the world as the filter has it now: between corrections that is odometry.
landmarks::TSighting CSalientEKF2D::sightingOf(const TMeasurement& measurement) const {
    landmarks::TSighting sighting;
    sighting.position = located(poseMean(), measurement.z).landmark;
    sighting.robot = poseMean().head<2>();
    if (!std::isnan(measurement.wallAngle))
        sighting.wallAngle = mrpt::math::wrapToPi(poseMean()[2] + measurement.wallAngle);
    sighting.convex = measurement.convex;
    sighting.patch = measurement.patch;
    return sighting;
}

void CSalientEKF2D::learn() {
    const auto& measurements = m_now.input.measurements;
    const auto& evidence = m_now.judgement->evidence;
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        const bool created = m_now.decisions[i] == EDecision::created;
        if (!created && m_now.decisions[i] != EDecision::paired) continue;
        const auto index = static_cast<std::size_t>(m_now.landmarks[i]);
        // Asked before the table changes: what the pairing was judged by.
        const bool counted = !created && evidence && evidence->counts(i, index);
        if (m_now.confirms[i])
            m_landmarks.setConfirmed(index, true);
        else if (created && measurements[i].kind == ELandmarkKind::salient &&
                 !measurements[i].identity)
            m_landmarks.setConfirmed(index, false);
        const bool kept = m_landmarks.sight(index, measurements[i], m_now.input.time, heading());
        if (counted) m_landmarks.setCounted(index, viewingAngle(measurements[i]));
        if (kept && m_ratio) m_landmarks.findLookAlikes(index, m_ratio);
        if (!created) continue;
        const auto row = static_cast<Eigen::Index>(3 + 2 * index);
        m_landmarks.setFirst(index, Eigen::Vector2d(m_xkk[row], m_xkk[row + 1]),
                             m_pkk.asEigen().block<2, 2>(row, row));
    }
}

}  // namespace salma::slam
