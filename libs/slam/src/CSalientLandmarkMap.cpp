// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/association/CJointInnovation.h>
#include <salma/slam/CSalientLandmarkMap.h>
#include <salma/slam/rangeBearingModel.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace salma::slam {

using association::ELandmarkKind;
using association::EVerdict;
using association::TMeasurement;

namespace {

constexpr int kIterations = 3;
constexpr double kFar2 = 50;  // squared Mahalanobis distance from which a density is nothing

Eigen::Vector3d vectorOf(const mrpt::poses::CPose2D& pose) {
    return {pose.x(), pose.y(), pose.phi()};
}

bool isSound(const TMeasurement& m) {
    return m.z.allFinite() && m.R.allFinite() && m.R(0, 0) > 0 && m.R.determinant() > 0;
}

bool mayBe(const TMeasurement& m, const TLandmark& landmark) {
    if (m.kind != landmark.kind || m.convex != landmark.convex) return false;
    return !m.identity || !landmark.identity || *m.identity == *landmark.identity;
}

/// What a pose expects of a landmark.
struct TExpected {
    Eigen::Vector2d z;
    Matrix23 byPose;
    Eigen::Matrix2d H;           //!< By the landmark's place.
    Eigen::Matrix2d covariance;  //!< That the landmark's place gives it.
};

TExpected expect(const CSalientLandmarkMap::TPlace& place, const Eigen::Vector3d& pose) {
    const TSighting seen = sighting(pose, place.mean);
    return {seen.z, seen.byPose, seen.byLandmark,
            seen.byLandmark * place.covariance * seen.byLandmark.transpose()};
}

/// A pose that is taken for exact.
CSalientLandmarkMap::TPoseBelief exact(const mrpt::poses::CPose2D& pose) {
    return {vectorOf(pose), Eigen::Matrix3d::Zero()};
}

}  // namespace

CSalientLandmarkMap::CSalientLandmarkMap()
    : CSalientLandmarkMap(std::make_shared<const CLandmarkMapSetup>()) {}

CSalientLandmarkMap::CSalientLandmarkMap(std::shared_ptr<const CLandmarkMapSetup> setup)
    : m_setup(std::move(setup)),
      m_ratio(m_setup->patchRatio()),
      m_table(m_setup->options().map.maxPatches, m_setup->options().map.patchSpread) {}

bool CSalientLandmarkMap::isConfirmed(std::size_t index) const {
    const TLandmark& landmark = m_table[index];
    return landmark.kind == ELandmarkKind::salient || landmark.identity ||
           landmark.sightings >=
               static_cast<std::size_t>(m_setup->options().map.minSightingsCorner);
}

std::unique_ptr<CStepEvidence> CSalientLandmarkMap::evidenceOf(
    const association::TAssociationProblem& problem,
    const std::vector<std::size_t>& landmarks,
    double time) const {
    const auto& all = problem.measurements;
    const auto hasPatch = [](const TMeasurement& m) { return m.patch != nullptr; };
    if (landmarks.empty() || std::none_of(all.begin(), all.end(), hasPatch)) return nullptr;
    const auto& options = m_setup->options();
    const TEvidenceLimits limits{options.map.decorrelation, options.map.trackGap,
                                 options.association.forbidLogLr, options.association.gateQuantile};
    return std::make_unique<CStepEvidence>(limits, m_table, m_ratio, problem, time, landmarks);
}

double CSalientLandmarkMap::density(const association::TAssociationProblem& problem,
                                    const std::vector<std::size_t>& landmarks,
                                    std::size_t observation,
                                    CStepEvidence* evidence) const {
    const auto& options = m_setup->options().association;
    const TMeasurement& m = problem.measurements[observation];
    const bool corner = m.kind == ELandmarkKind::corner;
    double sum = std::exp(corner ? options.cornerLogDensity : options.salientLogDensity);
    for (std::size_t k = 0; k < landmarks.size(); ++k) {
        if (!mayBe(m, m_table[landmarks[k]]) || !isConfirmed(landmarks[k])) continue;
        const auto row = static_cast<Eigen::Index>(2 * k);
        const Eigen::Matrix2d S = problem.predictionCovariance.block<2, 2>(row, row) + m.R;
        const Eigen::Vector2d nu = association::innovation(m.z, problem.landmarks[k].z);
        if (!(nu[0] * nu[0] <= kFar2 * S(0, 0))) continue;
        const double distance2 = nu.dot(S.inverse() * nu);
        if (!(distance2 <= kFar2)) continue;
        double appearance = m.patch && evidence ? evidence->logRatio(observation, k) : 0;
        if (std::isnan(appearance)) appearance = 0;
        sum += options.detectionProbability * std::exp(appearance - 0.5 * distance2) /
               (2 * M_PI * std::sqrt(S.determinant()));
    }
    return sum;
}

double CSalientLandmarkMap::logLikelihood(const std::vector<TMeasurement>& measurements,
                                          const mrpt::poses::CPose2D& pose,
                                          double time) const {
    std::vector<TMeasurement> sound;
    std::copy_if(measurements.begin(), measurements.end(), std::back_inserter(sound), isSound);
    const auto landmarks = near(sound, exact(pose));
    const auto posed = problem(sound, landmarks, exact(pose));
    const auto evidence = evidenceOf(posed, landmarks, time);
    double sum = 0;
    for (std::size_t i = 0; i < sound.size(); ++i)
        sum += std::log(density(posed, landmarks, i, evidence.get()));
    return sum;
}

/// Landmarks that one of the measurements could be, or lies too near to for a new one.
std::vector<std::size_t> CSalientLandmarkMap::near(const std::vector<TMeasurement>& measurements,
                                                   const TPoseBelief& pose) const {
    const double far2 = std::max(kFar2, 2 * m_setup->options().association.newDistance2);
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < size(); ++k) {
        const TExpected expected = expect(m_places[k], pose.mean);
        const Eigen::Vector2d variance =
            (expected.covariance + expected.byPose * pose.covariance * expected.byPose.transpose())
                .diagonal();
        const auto isNear = [&](const TMeasurement& m) {
            if (m.identity && m_table[k].identity) return *m.identity == *m_table[k].identity;
            const double range = m.z[0] - expected.z[0];
            const double bearing = mrpt::math::wrapToPi(m.z[1] - expected.z[1]);
            return range * range <= far2 * (variance[0] + m.R(0, 0)) &&
                   bearing * bearing <= far2 * (variance[1] + m.R(1, 1));
        };
        if (std::any_of(measurements.begin(), measurements.end(), isNear)) result.push_back(k);
    }
    return result;
}

association::TAssociationProblem CSalientLandmarkMap::problem(
    const std::vector<TMeasurement>& measurements,
    const std::vector<std::size_t>& landmarks,
    const TPoseBelief& pose) const {
    const double sigma = std::hypot(m_setup->options().map.headingSigma,
                                    std::sqrt(std::max(0.0, pose.covariance(2, 2))));
    const THeading heading{pose.mean[2], sigma};
    association::TAssociationProblem result;
    result.measurements = measurements;
    const auto rows = static_cast<Eigen::Index>(2 * landmarks.size());
    Eigen::MatrixX3d byPose(rows, 3);
    result.predictionCovariance.setZero(rows, rows);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
        const TExpected expected = expect(m_places[landmarks[i]], pose.mean);
        auto landmark = m_table.expected(landmarks[i], heading);
        landmark.z = expected.z;
        result.landmarks.push_back(landmark);
        const auto row = static_cast<Eigen::Index>(2 * i);
        byPose.middleRows<2>(row) = expected.byPose;
        result.predictionCovariance.block<2, 2>(row, row) = expected.covariance;
    }
    if (!pose.covariance.isZero(0))
        result.predictionCovariance += byPose * pose.covariance * byPose.transpose();
    return result;
}

CSalientLandmarkMap::TPoseBelief CSalientLandmarkMap::corrected(
    const std::vector<TMeasurement>& measurements,
    const TPoseBelief& predicted,
    double time,
    double power) const {
    auto landmarks = near(measurements, predicted);
    landmarks.erase(std::remove_if(landmarks.begin(), landmarks.end(),
                                   [this](std::size_t k) { return !isConfirmed(k); }),
                    landmarks.end());
    auto posed = problem(measurements, landmarks, predicted);
    const auto evidence = evidenceOf(posed, landmarks, time);
    if (evidence)
        posed.logRatio = [&](std::size_t i, std::size_t k) { return evidence->logRatio(i, k); };
    const auto association = m_setup->associator().associate(posed);
    if (association.pairings == 0) return predicted;
    const auto& decisions = association.decisions;
    const Eigen::Matrix3d prior = predicted.covariance.inverse();
    TPoseBelief result = predicted;
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        Eigen::Matrix3d information = prior;
        Eigen::Vector3d back = predicted.mean - result.mean;
        back[2] = mrpt::math::wrapToPi(back[2]);
        Eigen::Vector3d pull = prior * back;
        for (std::size_t i = 0; i < decisions.size(); ++i) {
            if (decisions[i].verdict != EVerdict::paired) continue;
            const auto& m = measurements[i];
            const TExpected expected = expect(
                m_places[landmarks[static_cast<std::size_t>(decisions[i].landmark)]], result.mean);
            const Eigen::Matrix2d weight = power * (expected.covariance + m.R).inverse();
            information += expected.byPose.transpose() * weight * expected.byPose;
            pull += expected.byPose.transpose() * weight * association::innovation(m.z, expected.z);
        }
        result.covariance = information.inverse();
        result.mean += result.covariance * pull;
        result.mean[2] = mrpt::math::wrapToPi(result.mean[2]);
    }
    const bool sound = result.mean.allFinite() && result.covariance.allFinite() &&
                       result.covariance.llt().info() == Eigen::Success;
    return sound ? result : predicted;
}

void CSalientLandmarkMap::update(std::size_t index,
                                 const TMeasurement& m,
                                 const Eigen::Vector3d& pose,
                                 TOutcome& outcome) {
    TPlace& place = m_places[index];
    const TExpected expected = expect(place, pose);
    const Eigen::Matrix2d S = expected.covariance + m.R;
    const Eigen::Matrix2d gain = place.covariance * expected.H.transpose() * S.inverse();
    const Eigen::Matrix2d keep = Eigen::Matrix2d::Identity() - gain * expected.H;
    outcome.innovation = association::innovation(m.z, expected.z);
    outcome.sigma = S.diagonal().cwiseSqrt();
    place.mean += gain * outcome.innovation;
    place.covariance = keep * place.covariance * keep.transpose() + gain * m.R * gain.transpose();
}

std::size_t CSalientLandmarkMap::enter(const TMeasurement& m,
                                       const Eigen::Vector3d& pose,
                                       double time) {
    const TLocated found = located(pose, m.z);
    TPlace place;
    place.mean = found.landmark;
    place.covariance = found.byMeasurement * m.R * found.byMeasurement.transpose();
    place.born = m_insertions;
    m_table.add(m, time);
    m_table.setFirst(size(), place.mean, place.covariance);
    m_places.push_back(place);
    return size() - 1;
}

void CSalientLandmarkMap::forgetProvisional() {
    const auto patience = static_cast<std::size_t>(m_setup->options().map.provisionalSteps);
    for (std::size_t k = size(); k-- > 0;) {
        if (isConfirmed(k) || m_insertions - m_places[k].born < patience) continue;
        m_table.erase(k);
        m_places.erase(m_places.begin() + static_cast<std::ptrdiff_t>(k));
    }
}

void CSalientLandmarkMap::learn(const std::vector<TMeasurement>& measurements,
                                const mrpt::poses::CPose2D& at,
                                double time) {
    const Eigen::Vector3d pose = vectorOf(at);
    const THeading heading{pose[2], m_setup->options().map.headingSigma};
    ++m_insertions;
    const auto landmarks = near(measurements, exact(at));
    auto posed = problem(measurements, landmarks, exact(at));
    const auto evidence = evidenceOf(posed, landmarks, time);
    if (evidence)
        posed.logRatio = [&](std::size_t i, std::size_t k) { return evidence->logRatio(i, k); };
    const auto association = m_setup->associator().associate(posed);
    m_outcomes = {};
    for (auto candidate : association.candidates) {
        candidate.landmark = static_cast<std::size_t>(m_table[landmarks[candidate.landmark]].id);
        m_outcomes.candidates.push_back(candidate);
    }
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        TOutcome outcome;
        outcome.decision = association.decisions[i];
        std::size_t index = size();
        bool counted = false;  // asked before the table changes
        if (outcome.decision.verdict == EVerdict::paired) {
            const auto chosen = static_cast<std::size_t>(outcome.decision.landmark);
            counted = evidence && evidence->counts(i, chosen);
            index = landmarks[chosen];
            update(index, measurements[i], pose, outcome);
        } else if (outcome.decision.verdict == EVerdict::created) {
            index = enter(measurements[i], pose, time);
        }
        if (index < size()) {
            const bool kept = m_table.sight(index, measurements[i], time, heading);
            if (counted) m_table.setCounted(index, viewingAngle(measurements[i]));
            if (kept && measurements[i].patch) m_table.findLookAlikes(index, m_ratio);
            outcome.decision.landmark = m_table[index].id;
            outcome.provisional = !isConfirmed(index);
        }
        m_outcomes.measurements.push_back(outcome);
    }
    forgetProvisional();
}

void CSalientLandmarkMap::internal_clear() {
    m_table.restore({}, 0);
    m_places.clear();
    m_outcomes = {};
    m_insertions = 0;
}

std::string CSalientLandmarkMap::asString() const {
    std::size_t salient = 0, provisional = 0;
    for (std::size_t k = 0; k < size(); ++k)
        if (!isConfirmed(k))
            ++provisional;
        else if (m_table[k].kind == ELandmarkKind::salient)
            ++salient;
    std::ostringstream text;
    text << "Landmark map: " << salient << " salient, " << size() - salient - provisional
         << " corners, " << provisional << " provisional";
    return text.str();
}

}  // namespace salma::slam
