// SPDX-License-Identifier: BSD-3-Clause
// When the local map is looked for in the map that was left behind.
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/CMapJoin.h>
#include <salma/slam/CPathSmoother.h>
#include <salma/slam/CSalientEKF2D.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planeMotion.h"

namespace salma::slam {

using association::ELandmarkKind;

namespace {

constexpr int extensions = 3;         // of the local map; more add nothing
constexpr double closerTravel = 1.5;  // to the next attempt after a closer look [m]
constexpr double refusedTravel = 3;   // to the next attempt after a join that failed [m]
constexpr double unsureNearby = 0.5;  // of the prediction of a landmark that was just used [m]
constexpr double vagueSigma = 0.1;    // of a prediction: its derivatives were not exact [m]

}  // namespace

/// Keeps what this step brought, so that path and map can be estimated anew.
void CSalientEKF2D::remember() {
    TPastStep step;
    const TStepInput& input = m_now.input;
    step.time = input.time;
    step.increment << input.increment.mean.x(), input.increment.mean.y(),
        input.increment.mean.phi();
    step.Q = input.increment.cov.asEigen();
    step.pose = poseMean();
    static_cast<TViews&>(step) = input;
    for (std::size_t i = 0; i < input.measurements.size(); ++i) {
        const EDecision decision = m_now.decisions[i];
        if (decision != EDecision::paired && decision != EDecision::created) continue;
        const auto index = static_cast<std::size_t>(m_now.landmarks[i]);
        step.used.push_back(
            {m_landmarks[index].id, input.measurements[i].z, input.measurements[i].R});
    }
    m_history.add(std::move(step));
    noteUse();
}

/* The filter takes a long step with derivatives from before it where landmarks are paired that
 * were not seen for long and were predicted vaguely. */
void CSalientEKF2D::noteUse() {
    const double now = m_history.back().travel;
    for (std::size_t i = 0; i < m_now.decisions.size(); ++i) {
        const EDecision decision = m_now.decisions[i];
        if (decision != EDecision::paired && decision != EDecision::created) continue;
        const auto index = static_cast<std::size_t>(m_now.landmarks[i]);
        const auto [last, isNew] = m_lastUsed.insert({m_landmarks[index].id, now});
        if (!isNew && last->second < now - m_care.relocation.gap &&
            m_now.judgement->sigmas[index] > vagueSigma)
            m_now.closesLoop = true;
        last->second = now;
    }
}

/** Sigma of a landmark's prediction up to which the filter pairs it by itself [m].
 *
 * Where a landmark was not used for long, another one like it may come into view. A map without a
 * poster has nothing by which relocation could tell them apart. */
double CSalientEKF2D::largestSigma(std::size_t landmark, bool hasPoster) const {
    if (!m_relocates) return std::numeric_limits<double>::infinity();
    const double unsure = m_care.relocation.unsure, nearby = std::max(unsure, unsureNearby);
    if (m_history.empty() || !hasPoster) return nearby;
    const auto last = m_lastUsed.find(m_landmarks[landmark].id);
    const bool isLeftBehind =
        last == m_lastUsed.end() || last->second < m_history.back().travel - m_care.relocation.gap;
    return isLeftBehind ? unsure : nearby;
}

void CSalientEKF2D::relocate() {
    const double travel = m_history.back().travel;
    const bool showsLandmark = std::any_of(m_now.landmarks.begin(), m_now.landmarks.end(),
                                           [](int index) { return index >= 0; });
    if (!showsLandmark || travel < m_lastAttempt + m_care.relocation.every) return;
    m_lastAttempt = travel;
    const TFilterState now = state();
    const Eigen::VectorXd mean = now.mean;
    const RowMatrix covariance = now.covariance;
    TRelocation found = m_relocator.find(
        {m_landmarks, mean, covariance, m_history, m_ratio, m_ekf.maxRange, m_ekf.fieldOfView / 2});
    if (found.outcome == ERelocation::found && isWorthAJoin(found.best)) {
        if (!extend(found.best)) return refuse(found);
        m_lastAttempt += closerTravel;
        if (!m_relocator.proves(found.best)) found.outcome = ERelocation::unproved;
        if (found.outcome == ERelocation::found && !join(found)) return refuse(found);
    }
    if (found.outcome == ERelocation::unproved) noteRelocation("unproved", found);
    if (found.outcome == ERelocation::ambiguous) noteRelocation("ambiguous", found);
}

/// Half a metre later it would be the same.
void CSalientEKF2D::refuse(const TRelocation& found) {
    noteRelocation("refused", found);
    m_lastAttempt += refusedTravel;
}

/// A join is for what the filter cannot pair by itself, and takes more than a chance meeting.
bool CSalientEKF2D::isWorthAJoin(const TAlignment& alignment) const {
    const auto& pairs = alignment.pairs;
    const bool isOutOfReach = std::any_of(pairs.begin(), pairs.end(), [this](const auto& pair) {
        return pair.left < m_now.judgement->sigmas.size() &&
               m_now.judgement->sigmas[pair.left] > m_care.relocation.unsure;
    });
    const std::size_t posters = alignment.matchedPosters();
    return isOutOfReach ? pairs.size() >= 4 || posters >= 2 : pairs.size() >= 4 && posters >= 2;
}

/* The local map is short, so that it is stiff. Once it is laid onto the other, what was seen before
 * it falls into place as well, and may speak for the alignment or against it. False if the path
 * does not allow the alignment. */
bool CSalientEKF2D::extend(TAlignment& alignment) {
    const Eigen::VectorXd mean = state().mean;
    const RowMatrix covariance = state().covariance;
    const CMapJoin join(m_history, m_landmarks, mean);
    for (int round = 0; round < extensions; ++round) {
        const auto joined = join.fitting(alignment, false);
        if (!joined) return false;
        const TLaidMaps both = join.laid(*joined);
        const std::size_t before = alignment.pairs.size();
        alignment = m_relocator.extended({both.landmarks, both.mean, covariance, both.history,
                                          m_ratio, m_ekf.maxRange, m_ekf.fieldOfView / 2},
                                         alignment);
        if (alignment.pairs.size() <= before) break;
    }
    return true;
}

bool CSalientEKF2D::join(TRelocation& found) {
    const Eigen::VectorXd mean = state().mean;
    auto joined = CMapJoin(m_history, m_landmarks, mean).fitting(found.best, true);
    if (!joined) return false;
    noteRelocation("joined", found);  // by the ids before the join
    for (std::size_t i = 0; i < m_now.landmarks.size(); ++i) {
        if (m_now.landmarks[i] < 0) continue;
        const int id = m_landmarks[static_cast<std::size_t>(m_now.landmarks[i])].id;
        if (joined->keptOf.count(id) != 0) m_now.decisions[i] = EDecision::relocated;
        m_now.landmarks[i] = static_cast<int>(joined->indexOf(id));
    }
    for (const auto& [gone, kept] : joined->keptOf) {
        m_history.rename(gone, kept);
        m_lastUsed[kept] = std::max(m_lastUsed[kept], m_lastUsed[gone]);
        m_lastUsed.erase(gone);
        m_looks.forget(gone);
    }
    m_landmarks = std::move(joined->landmarks);
    setState(joined->smoothed);
    ++m_record.joins;
    return true;
}

/// The history's poses are those of before.
void CSalientEKF2D::setState(const TSmoothed& smoothed) {
    const auto steps = m_history.steps();
    for (std::size_t i = 0; i < m_landmarks.size(); ++i) {
        const std::size_t last = steps.at(m_landmarks[i].id).second;
        m_landmarks.turn(i, smoothed.poses[last][2] - m_history[last].pose[2]);
    }
    const Eigen::Vector3d motion =
        appliedToPose(smoothed.poses.back(), inverseOf(m_history.back().pose));
    m_provisionalCorners.move(motion);
    m_provisionalEntities.move(motion);
    for (std::size_t k = 0; k < m_history.size(); ++k) m_history.setPose(k, smoothed.poses[k]);
    const Eigen::Index size = smoothed.mean.size();
    m_xkk.resize(size);
    m_pkk.setSize(size, size);
    TFilterState now = state();
    now.mean = smoothed.mean;
    now.covariance = smoothed.covariance;
    m_IDs.clear();
    for (std::size_t i = 0; i < m_landmarks.size(); ++i)
        m_IDs.insert(m_landmarks[i].id, static_cast<unsigned>(i));
    m_base.setZero();
    m_baseCovariance.setZero();
    m_lastSmoothing = m_history.back().travel;
}

/// Path and map anew, with all derivatives taken at the result.
void CSalientEKF2D::smooth() {
    std::vector<int> order;
    std::vector<Eigen::Vector2d> places;
    for (std::size_t i = 0; i < m_landmarks.size(); ++i) {
        order.push_back(m_landmarks[i].id);
        places.emplace_back(m_xkk[3 + 2 * i], m_xkk[4 + 2 * i]);
    }
    setState(CPathSmoother().smooth(m_history, order, places));
}

Eigen::Matrix3d CSalientEKF2D::poseCovariance() const {
    return m_pkk.asEigen().topLeftCorner<3, 3>() + carried(m_baseCovariance, m_base, poseMean());
}

void CSalientEKF2D::anchor() {
    if (std::sqrt(m_pkk(2, 2)) <= m_care.relocation.anchorSigma) return;
    m_baseCovariance = poseCovariance();
    m_base = poseMean();
    anchorAtRobot(state());
}

bool CSalientEKF2D::keepsHistory() const {
    return m_relocates || (m_ekf.smooth && m_ekf.update == EUpdate::block);
}

/// The covariance is stated in the world again, and the path is what all measurements make of it.
void CSalientEKF2D::finish() {
    if (m_history.empty()) return;
    if (m_ekf.smooth || !m_baseCovariance.isZero(0)) smooth();
    if (!m_ekf.smooth) return;
    for (std::size_t k = 0; k < m_history.size(); ++k) {
        const Eigen::Vector3d& pose = m_history[k].pose;
        m_record.trajectory[k].pose = mrpt::poses::CPose2D(pose[0], pose[1], pose[2]);
    }
    m_record.smoothed = true;
}

void CSalientEKF2D::noteRelocation(const std::string& outcome, const TRelocation& found) {
    const TAlignment& best = found.best;
    const Eigen::Vector3d moved = appliedToPose(best.T, poseMean());
    for (const TSameLandmark& pair : best.pairs) {
        TRelocationRow row;
        row.time = m_now.input.time;
        row.outcome = outcome;
        row.kind = m_landmarks[pair.local].kind;
        row.local = m_landmarks[pair.local].id;
        row.left = m_landmarks[pair.left].id;
        row.distance = pair.distance;
        row.logRatio = pair.logRatio;
        row.shiftX = moved[0] - m_xkk[0];
        row.shiftY = moved[1] - m_xkk[1];
        row.turn = mrpt::math::wrapToPi(best.T[2]);
        row.posters = best.posters;
        row.corners = best.corners;
        row.odometry = best.odometry;
        row.margin = found.margin;
        m_record.relocations.push_back(row);
    }
}

}  // namespace salma::slam
