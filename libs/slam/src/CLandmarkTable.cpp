// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/CLandmarkTable.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace salma::slam {

CLandmarkTable::CLandmarkTable(int maxPatches, double patchSpread)
    : m_maxPatches(static_cast<std::size_t>(maxPatches)), m_patchSpread(patchSpread) {}

int CLandmarkTable::add(const association::TMeasurement& measurement, double time) {
    TLandmark landmark;
    landmark.id = m_nextId;
    landmark.kind = measurement.kind;
    landmark.convex = measurement.convex;
    landmark.identity = measurement.identity;
    landmark.wallAngle = landmark.firstWallAngle = std::numeric_limits<double>::quiet_NaN();
    landmark.firstTime = time;
    if (measurement.identity) {
        const int id = *measurement.identity;
        const bool used = std::any_of(m_landmarks.begin(), m_landmarks.end(),
                                      [id](const TLandmark& other) { return other.id == id; });
        if (!used) landmark.id = id;
    }
    m_nextId = std::max(m_nextId, landmark.id + 1);
    m_landmarks.push_back(landmark);
    return landmark.id;
}

void CLandmarkTable::setFirst(std::size_t index,
                              const Eigen::Vector2d& mean,
                              const Eigen::Matrix2d& covariance) {
    m_landmarks[index].firstMean = {mean[0], mean[1]};
    m_landmarks[index].firstCovariance = covariance;
}

void CLandmarkTable::erase(std::size_t index) {
    m_landmarks.erase(m_landmarks.begin() + static_cast<std::ptrdiff_t>(index));
}

void CLandmarkTable::restore(std::vector<TLandmark> landmarks, int nextId) {
    m_landmarks = std::move(landmarks);
    m_nextId = nextId;
}

void CLandmarkTable::sight(std::size_t index,
                           const association::TMeasurement& measurement,
                           double time,
                           const THeading& heading) {
    TLandmark& landmark = m_landmarks[index];
    ++landmark.sightings;
    landmark.lastTime = time;
    if (!landmark.identity) landmark.identity = measurement.identity;
    double angle = measurement.patch ? measurement.patch->incidence : 0;
    if (!std::isnan(measurement.wallAngle)) {
        angle = mrpt::math::wrapToPi(measurement.z[1] + M_PI - measurement.wallAngle);
        const double sigma = std::hypot(measurement.wallAngleSigma, heading.sigma);
        if (std::isnan(landmark.wallAngle) || sigma < landmark.wallAngleSigma) {
            landmark.wallAngle = mrpt::math::wrapToPi(heading.mean + measurement.wallAngle);
            landmark.wallAngleSigma = sigma;
        }
        if (std::isnan(landmark.firstWallAngle)) landmark.firstWallAngle = landmark.wallAngle;
    }
    if (measurement.patch) addView(landmark, {measurement.patch, angle});
}

void CLandmarkTable::addView(TLandmark& landmark, const TView& view) {
    for (const TView& kept : landmark.views)
        if (!(std::abs(mrpt::math::wrapToPi(kept.angle - view.angle)) >= m_patchSpread)) return;
    landmark.views.push_back(view);
    if (landmark.views.size() <= m_maxPatches) return;
    landmark.views.erase(std::max_element(
        landmark.views.begin(), landmark.views.end(),
        [](const TView& a, const TView& b) { return std::abs(a.angle) < std::abs(b.angle); }));
}

association::TPredictedLandmark CLandmarkTable::expected(std::size_t index,
                                                         const THeading& heading) const {
    const TLandmark& landmark = m_landmarks[index];
    association::TPredictedLandmark result;
    result.kind = landmark.kind;
    result.identity = landmark.identity;
    result.convex = landmark.convex;
    if (!std::isnan(landmark.wallAngle)) {
        result.wallAngle = mrpt::math::wrapToPi(landmark.wallAngle - heading.mean);
        result.wallAngleSigma = std::hypot(landmark.wallAngleSigma, heading.sigma);
    }
    return result;
}

double CLandmarkTable::bestRatio(std::size_t index,
                                 const observations::TPatch& seen,
                                 const PatchRatio& ratio) const {
    double best = std::numeric_limits<double>::quiet_NaN();
    for (const TView& view : m_landmarks[index].views)
        best = std::fmax(best, ratio(seen, *view.patch));  // fmax passes over NaN
    return best;
}

}  // namespace salma::slam
