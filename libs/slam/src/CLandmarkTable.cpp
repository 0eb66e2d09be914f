// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/CLandmarkTable.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace salma::slam {

double viewingAngle(const association::TMeasurement& measurement) {
    if (!std::isnan(measurement.wallAngle))
        return mrpt::math::wrapToPi(measurement.z[1] + M_PI - measurement.wallAngle);
    return measurement.patch ? measurement.patch->incidence : 0;
}

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

std::size_t CLandmarkTable::indexOf(int id) const {
    const auto found = std::find_if(m_landmarks.begin(), m_landmarks.end(),
                                    [id](const TLandmark& landmark) { return landmark.id == id; });
    if (found == m_landmarks.end())
        throw std::invalid_argument("The map has no landmark " + std::to_string(id));
    return static_cast<std::size_t>(found - m_landmarks.begin());
}

void CLandmarkTable::setFirst(std::size_t index,
                              const Eigen::Vector2d& mean,
                              const Eigen::Matrix2d& covariance) {
    m_landmarks[index].firstMean = {mean[0], mean[1]};
    m_landmarks[index].firstCovariance = covariance;
}

void CLandmarkTable::erase(std::size_t index) {
    for (TLandmark& other : m_landmarks) other.lookAlikes.erase(m_landmarks[index].id);
    m_landmarks.erase(m_landmarks.begin() + static_cast<std::ptrdiff_t>(index));
}

void CLandmarkTable::merge(std::size_t kept, std::size_t gone) {
    TLandmark& to = m_landmarks[kept];
    const TLandmark& from = m_landmarks[gone];
    to.sightings += from.sightings;
    to.confirmed = to.confirmed || from.confirmed;
    to.firstTime = std::min(to.firstTime, from.firstTime);
    if (from.lastTime >= to.lastTime) to.countedAngle = from.countedAngle;
    to.lastTime = std::max(to.lastTime, from.lastTime);
    if (!to.identity) to.identity = from.identity;
    if (std::isnan(to.wallAngle)) {
        to.wallAngle = from.wallAngle;
        to.wallAngleSigma = from.wallAngleSigma;
    }
    for (const int id : from.lookAlikes) {
        if (id == to.id) continue;
        to.lookAlikes.insert(id);
        for (TLandmark& other : m_landmarks)
            if (other.id == id) other.lookAlikes.insert(to.id);
    }
    for (const TView& view : from.views) addView(to, view);
    erase(gone);
}

void CLandmarkTable::turn(std::size_t index, double angle) {
    double& wall = m_landmarks[index].wallAngle;
    wall = mrpt::math::wrapToPi(wall + angle);  // NaN stays NaN
}

void CLandmarkTable::restore(std::vector<TLandmark> landmarks, int nextId) {
    m_landmarks = std::move(landmarks);
    m_nextId = nextId;
}

bool CLandmarkTable::sight(std::size_t index,
                           const association::TMeasurement& measurement,
                           double time,
                           const THeading& heading) {
    TLandmark& landmark = m_landmarks[index];
    ++landmark.sightings;
    landmark.lastTime = time;
    if (!landmark.identity) landmark.identity = measurement.identity;
    if (!std::isnan(measurement.wallAngle)) {
        const double sigma = std::hypot(measurement.wallAngleSigma, heading.sigma);
        if (std::isnan(landmark.wallAngle) || sigma < landmark.wallAngleSigma) {
            landmark.wallAngle = mrpt::math::wrapToPi(heading.mean + measurement.wallAngle);
            landmark.wallAngleSigma = sigma;
        }
        if (std::isnan(landmark.firstWallAngle)) landmark.firstWallAngle = landmark.wallAngle;
    }
    return measurement.patch && addView(landmark, {measurement.patch, viewingAngle(measurement)});
}

bool CLandmarkTable::addView(TLandmark& landmark, const TView& view) {
    for (const TView& kept : landmark.views)
        if (!(std::abs(mrpt::math::wrapToPi(kept.angle - view.angle)) >= m_patchSpread))
            return false;
    landmark.views.push_back(view);
    if (landmark.views.size() <= m_maxPatches) return true;
    landmark.views.erase(std::max_element(
        landmark.views.begin(), landmark.views.end(),
        [](const TView& a, const TView& b) { return std::abs(a.angle) < std::abs(b.angle); }));
    return landmark.views.back().patch == view.patch;
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

void CLandmarkTable::findLookAlikes(std::size_t index, const PatchRatio& ratio) {
    TLandmark& landmark = m_landmarks[index];
    if (landmark.views.empty()) return;
    const TView& view = landmark.views.back();
    const auto change = [&](const TView& other) {
        return std::abs(mrpt::math::wrapToPi(other.angle - view.angle));
    };
    for (std::size_t k = 0; k < m_landmarks.size(); ++k) {
        TLandmark& other = m_landmarks[k];
        if (k == index || other.views.empty() || landmark.lookAlikes.count(other.id) != 0) continue;
        const auto nearest =
            std::min_element(other.views.begin(), other.views.end(),
                             [&](const TView& a, const TView& b) { return change(a) < change(b); });
        if (!(ratio(*view.patch, *nearest->patch) > 0)) continue;
        landmark.lookAlikes.insert(other.id);
        other.lookAlikes.insert(landmark.id);
    }
}

double CLandmarkTable::lookAlikeShare(std::size_t index) const {
    if (m_landmarks[index].lookAlikes.empty()) return 0;
    const auto withViews = std::count_if(m_landmarks.begin(), m_landmarks.end(),
                                         [](const TLandmark& l) { return !l.views.empty(); });
    return static_cast<double>(m_landmarks[index].lookAlikes.size()) /
           static_cast<double>(withViews);
}

}  // namespace salma::slam
