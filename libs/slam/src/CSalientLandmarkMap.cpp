// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/association/CJointInnovation.h>
#include <salma/slam/CSalientLandmarkMap.h>
#include <salma/slam/rangeBearingModel.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>

namespace salma::slam {

using association::ELandmarkKind;
using association::EVerdict;
using association::TMeasurement;

namespace {

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

/// What a pose expects of a landmark, with the covariance that the landmark's place gives it.
struct TExpected {
    Eigen::Vector2d z;
    Eigen::Matrix2d H;  //!< By the landmark's place.
    Eigen::Matrix2d covariance;
};

TExpected expect(const CSalientLandmarkMap::TPlace& place, const Eigen::Vector3d& pose) {
    const TSighting seen = sighting(pose, place.mean);
    return {seen.z, seen.byLandmark,
            seen.byLandmark * place.covariance * seen.byLandmark.transpose()};
}

}  // namespace

CSalientLandmarkMap::CSalientLandmarkMap()
    : CSalientLandmarkMap(std::make_shared<const CLandmarkMapSetup>()) {}

CSalientLandmarkMap::CSalientLandmarkMap(std::shared_ptr<const CLandmarkMapSetup> setup)
    : m_setup(std::move(setup)),
      m_table(m_setup->options().map.maxPatches, m_setup->options().map.patchSpread) {}

bool CSalientLandmarkMap::isConfirmed(std::size_t index) const {
    const TLandmark& landmark = m_table[index];
    return landmark.kind == ELandmarkKind::salient || landmark.identity ||
           landmark.sightings >=
               static_cast<std::size_t>(m_setup->options().map.minSightingsCorner);
}

double CSalientLandmarkMap::density(const TMeasurement& m, const Eigen::Vector3d& pose) const {
    const auto& options = m_setup->options().association;
    const bool corner = m.kind == ELandmarkKind::corner;
    double sum = std::exp(corner ? options.cornerLogDensity : options.salientLogDensity);
    const PatchRatio ratio = [this](const auto& seen, const auto& stored) {
        return m_setup->logRatio(seen, stored);
    };
    for (std::size_t k = 0; k < size(); ++k) {
        const TLandmark& landmark = m_table[k];
        if (!mayBe(m, landmark) || !isConfirmed(k)) continue;
        const TExpected expected = expect(m_places[k], pose);
        const Eigen::Matrix2d S = expected.covariance + m.R;
        const Eigen::Vector2d nu = association::innovation(m.z, expected.z);
        if (!(nu[0] * nu[0] <= kFar2 * S(0, 0))) continue;
        const double distance2 = nu.dot(S.inverse() * nu);
        if (!(distance2 <= kFar2)) continue;
        double appearance = m.patch ? m_table.bestRatio(k, *m.patch, ratio) : 0;
        if (std::isnan(appearance)) appearance = 0;
        sum += options.detectionProbability * std::exp(appearance - 0.5 * distance2) /
               (2 * M_PI * std::sqrt(S.determinant()));
    }
    return sum;
}

double CSalientLandmarkMap::logLikelihood(const std::vector<TMeasurement>& measurements,
                                          const mrpt::poses::CPose2D& pose) const {
    double sum = 0;
    for (const TMeasurement& m : measurements)
        if (isSound(m)) sum += std::log(density(m, vectorOf(pose)));
    return sum;
}

/// Landmarks that one of the measurements could be, or lies too near to for a new one.
std::vector<std::size_t> CSalientLandmarkMap::near(const std::vector<TMeasurement>& measurements,
                                                   const Eigen::Vector3d& pose) const {
    const double far2 = 2 * m_setup->options().association.newDistance2;
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < size(); ++k) {
        const TExpected expected = expect(m_places[k], pose);
        const auto isNear = [&](const TMeasurement& m) {
            if (m.identity && m_table[k].identity) return *m.identity == *m_table[k].identity;
            const double range = m.z[0] - expected.z[0];
            const double bearing = mrpt::math::wrapToPi(m.z[1] - expected.z[1]);
            return range * range <= far2 * (expected.covariance(0, 0) + m.R(0, 0)) &&
                   bearing * bearing <= far2 * (expected.covariance(1, 1) + m.R(1, 1));
        };
        if (std::any_of(measurements.begin(), measurements.end(), isNear)) result.push_back(k);
    }
    return result;
}

association::TAssociationProblem CSalientLandmarkMap::problem(
    const std::vector<TMeasurement>& measurements,
    const std::vector<std::size_t>& landmarks,
    const Eigen::Vector3d& pose) const {
    const THeading heading{pose[2], m_setup->options().map.headingSigma};
    association::TAssociationProblem result;
    result.measurements = measurements;
    const auto rows = static_cast<Eigen::Index>(2 * landmarks.size());
    result.predictionCovariance.setZero(rows, rows);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
        const TExpected expected = expect(m_places[landmarks[i]], pose);
        auto landmark = m_table.expected(landmarks[i], heading);
        landmark.z = expected.z;
        result.landmarks.push_back(landmark);
        const auto row = static_cast<Eigen::Index>(2 * i);
        result.predictionCovariance.block<2, 2>(row, row) = expected.covariance;
    }
    result.logRatio = [this, landmarks, &measurements](std::size_t observation, std::size_t i) {
        const auto& seen = measurements[observation].patch;
        const PatchRatio ratio = [this](const auto& a, const auto& b) {
            return m_setup->logRatio(a, b);
        };
        return seen ? m_table.bestRatio(landmarks[i], *seen, ratio)
                    : std::numeric_limits<double>::quiet_NaN();
    };
    return result;
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
    const auto landmarks = near(measurements, pose);
    const auto association =
        m_setup->associator().associate(problem(measurements, landmarks, pose));
    m_outcomes = {};
    for (auto candidate : association.candidates) {
        candidate.landmark = static_cast<std::size_t>(m_table[landmarks[candidate.landmark]].id);
        m_outcomes.candidates.push_back(candidate);
    }
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        TOutcome outcome;
        outcome.decision = association.decisions[i];
        std::size_t index = size();
        if (outcome.decision.verdict == EVerdict::paired) {
            index = landmarks[static_cast<std::size_t>(outcome.decision.landmark)];
            update(index, measurements[i], pose, outcome);
        } else if (outcome.decision.verdict == EVerdict::created) {
            index = enter(measurements[i], pose, time);
        }
        if (index < size()) {
            m_table.sight(index, measurements[i], time, heading);
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
