// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/association/CJointInnovation.h>
#include <salma/slam/CStepEvidence.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace salma::slam {
namespace {

/// Quantile of chi-square with two degrees of freedom, which has a closed form.
double gateOf(double quantile) { return -2 * std::log(1 - quantile); }

/// The ratio once a share q of the others looks the same.
double withLookAlikes(double logRatio, double q) {
    if (!(logRatio > 0)) return logRatio;
    return -std::log((1 - q) * std::exp(-logRatio) + q);
}

}  // namespace

CStepEvidence::CStepEvidence(const TEvidenceLimits& limits,
                             const CLandmarkTable& landmarks,
                             const PatchRatio& ratio,
                             const association::TAssociationProblem& problem,
                             double time,
                             std::vector<std::size_t> selected)
    : m_limits(limits),
      m_landmarks(landmarks),
      m_ratio(ratio),
      m_time(time),
      m_selected(std::move(selected)),
      m_measurements(problem.measurements),
      m_goesOn(problem.measurements.size(), false) {
    const association::CJointInnovation alone(problem);
    const double gate = gateOf(m_limits.gateQuantile);
    for (std::size_t i = 0; i < m_measurements.size(); ++i)
        for (std::size_t j = 0; j < problem.landmarks.size() && !m_goesOn[i]; ++j) {
            if (!m_measurements[i].z.allFinite() || !isInTrack(i, j)) continue;
            const auto test = alone.test(i, j);
            m_goesOn[i] = test && test->distance2 <= gate && raw(i, j) > m_limits.forbid;
        }
}

bool CStepEvidence::isInTrack(std::size_t observation, std::size_t landmark) const {
    const TLandmark& known = m_landmarks[inTable(landmark)];
    if (!m_measurements[observation].patch || !known.countedAngle) return false;
    const double angle = viewingAngle(m_measurements[observation]);
    return m_time - known.lastTime <= m_limits.trackGap &&
           std::abs(mrpt::math::wrapToPi(angle - *known.countedAngle)) < m_limits.decorrelation;
}

double CStepEvidence::raw(std::size_t observation, std::size_t landmark) {
    const auto& patch = m_measurements[observation].patch;
    if (!patch) return std::numeric_limits<double>::quiet_NaN();
    const auto [entry, isNew] = m_raw.insert({{observation, landmark}, 0});
    if (isNew)
        entry->second = withLookAlikes(m_landmarks.bestRatio(inTable(landmark), *patch, m_ratio),
                                       m_landmarks.lookAlikeShare(inTable(landmark)));
    return entry->second;
}

double CStepEvidence::logRatio(std::size_t observation, std::size_t landmark) {
    const double ratio = raw(observation, landmark);
    if (!(ratio > m_limits.forbid) || !m_goesOn[observation]) return ratio;
    return isInTrack(observation, landmark) ? 0 : std::min(ratio, 0.0);
}

bool CStepEvidence::counts(std::size_t observation, std::size_t landmark) {
    return !std::isnan(raw(observation, landmark)) &&
           !(m_goesOn[observation] && isInTrack(observation, landmark));
}

}  // namespace salma::slam
