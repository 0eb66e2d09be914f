// SPDX-License-Identifier: BSD-3-Clause
#include "recordRows.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace salma::slam {

void checkStep(const TStepInput& step) {
    const auto& mean = step.increment.mean;
    const bool finite = std::isfinite(step.time) && std::isfinite(mean.x()) &&
                        std::isfinite(mean.y()) && std::isfinite(mean.phi()) &&
                        step.increment.cov.asEigen().allFinite();
    if (!finite) throw std::invalid_argument("Odometry of a step is not finite");
    if (!step.spots.empty() && step.spots.size() != step.measurements.size())
        throw std::invalid_argument("A step has " + std::to_string(step.spots.size()) +
                                    " places in the picture for " +
                                    std::to_string(step.measurements.size()) + " measurements");
}

EDecision decisionOf(association::EVerdict verdict) {
    using association::EVerdict;
    switch (verdict) {
        case EVerdict::paired:
            return EDecision::paired;
        case EVerdict::created:
            return EDecision::created;
        case EVerdict::deferred:
            return EDecision::deferred;
        case EVerdict::clutter:
            break;
    }
    return EDecision::clutter;
}

TAssociationRow associationRow(const TStepInput& step,
                               std::size_t measurement,
                               EDecision decision,
                               const association::TDecision& details,
                               int landmark) {
    const auto& m = step.measurements[measurement];
    const TSpot spot = step.spots.empty() ? TSpot() : step.spots[measurement];
    TAssociationRow row;
    row.time = step.time;
    row.observation = measurement;
    row.kind = m.kind;
    row.range = m.z[0];
    row.bearing = m.z[1];
    row.u = spot.pixel.x;
    row.v = spot.pixel.y;
    row.axisAngle = spot.axisAngle;
    row.decision = decision;
    row.landmark = landmark;
    row.distance2 = details.distance2;
    row.logRatio = details.logRatio;
    row.candidates = details.candidates;
    row.reason = details.reason;
    row.patch = m.patch;
    return row;
}

void addInnovation(double time,
                   const Eigen::Vector2d& nu,
                   const Eigen::Vector2d& sigma,
                   std::vector<TInnovationRow>& rows) {
    rows.push_back({time, "range_m", nu[0], sigma[0]});
    rows.push_back({time, "bearing_deg", mrpt::RAD2DEG(nu[1]), mrpt::RAD2DEG(sigma[1])});
}

TMapLandmark mapLandmarkOf(const TLandmark& landmark) {
    TMapLandmark result;
    result.id = landmark.id;
    result.kind = landmark.kind;
    result.firstMean = landmark.firstMean;
    result.firstCovariance = landmark.firstCovariance;
    result.sightings = landmark.sightings;
    result.firstTime = landmark.firstTime;
    result.lastTime = landmark.lastTime;
    result.wallAngle = landmark.firstWallAngle;
    const auto frontal = std::min_element(
        landmark.views.begin(), landmark.views.end(),
        [](const TView& a, const TView& b) { return std::abs(a.angle) < std::abs(b.angle); });
    if (frontal != landmark.views.end()) result.patch = frontal->patch;
    return result;
}

}  // namespace salma::slam
