// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/TPolarMeasurement.h>
#include <salma/sensing/CAttention.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace salma::sensing {
namespace {

using landmarks::TSighting;
using mrpt::poses::CPose2D;

/// Odometry drifts: places of long ago mean nothing.
constexpr std::size_t kMostDone = 100;

TSighting sightingOf(const observations::TPatch& patch, const CPose2D& T_o_r) {
    const auto& pose = patch.pose.mean;
    TSighting sighting;
    const auto at = T_o_r.composePoint(mrpt::math::TPoint2D(pose.x(), pose.y()));
    sighting.position = {at.x, at.y};
    sighting.robot = {T_o_r.x(), T_o_r.y()};
    sighting.wallAngle =
        mrpt::math::wrapToPi(T_o_r.phi() + appearance::polarMeasurement(patch).wallAngle);
    sighting.patch = std::make_shared<const observations::TPatch>(patch);
    return sighting;
}

}  // namespace

CAttention::CAttention(const TAttentionOptions& options,
                       const TGazeLimits& limits,
                       const landmarks::TTrackingOptions& tracking,
                       landmarks::CWideBaselineTracker::Ratio ratio)
    : m_options(options),
      m_limits(limits),
      m_tracking(tracking),
      m_tracker(tracking, std::move(ratio)) {
    m_options.validate();
    if (!reaches({options.restPan, options.restTilt}))
        throw std::invalid_argument("rest_pan_deg, rest_tilt_deg are out of the head's reach");
}

void CAttention::see(const observations::CObservationSalientLandmarks& record,
                     const CPose2D& T_o_r,
                     double now) {
    if (record.landmarks.empty()) return;
    m_tracker.beginStep();
    for (const auto& patch : record.landmarks) {
        const TSighting sighting = sightingOf(patch, T_o_r);
        if (isDone(sighting)) continue;
        const bool isTarget = m_target && isSamePlace(sighting, m_target->sighting, m_tracking);
        if (m_tracker.confirms(sighting)) {
            ++m_confirmed;
            finish(sighting);
            if (isTarget) m_target.reset();
        } else if (!m_target || isTarget) {
            m_target = TTarget{sighting, patch.pose.mean.z(), m_target ? m_target->since : now};
        }
    }
}

bool CAttention::isDone(const TSighting& sighting) const {
    return std::any_of(m_done.begin(), m_done.end(), [&](const TSighting& done) {
        return isSamePlace(sighting, done, m_tracking);
    });
}

void CAttention::finish(const TSighting& sighting) {
    if (m_done.size() >= kMostDone) m_done.erase(m_done.begin());
    m_done.push_back(sighting);
    m_done.back().patch.reset();
}

std::optional<TGaze> CAttention::gaze(const CPose2D& T_o_r,
                                      const observations::CObservationPanTilt& head,
                                      double now) {
    if (m_target && !(now - m_target->since < m_options.patience)) {
        ++m_letGo;
        finish(m_target->sighting);
        m_target.reset();
    }
    const TGaze next = wanted(T_o_r, head);
    const TGaze before = m_commanded.value_or(TGaze{head.pan, head.tilt});
    if (!(std::max(std::abs(next.pan - before.pan), std::abs(next.tilt - before.tilt)) >
          m_options.deadBand))
        return std::nullopt;
    m_commanded = next;
    return next;
}

TGaze CAttention::wanted(const CPose2D& T_o_r, const observations::CObservationPanTilt& head) {
    const TGaze rest{m_options.restPan, m_options.restTilt};
    if (!m_target) return rest;
    const auto& position = m_target->sighting.position;
    const auto at = T_o_r.inverseComposePoint(mrpt::math::TPoint2D(position.x(), position.y()));
    const TGaze gaze = gazeAt(head, {at.x, at.y, m_target->height});
    if (reaches(gaze)) return gaze;
    ++m_letGo;  // the robot has passed it
    finish(m_target->sighting);
    m_target.reset();
    return rest;
}

bool CAttention::reaches(const TGaze& gaze) const {
    return gaze.pan >= m_limits.panMin && gaze.pan <= m_limits.panMax &&
           gaze.tilt >= m_limits.tiltMin && gaze.tilt <= m_limits.tiltMax;
}

}  // namespace salma::sensing
