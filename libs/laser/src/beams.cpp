// SPDX-License-Identifier: BSD-3-Clause
#include "beams.h"

#include <algorithm>
#include <cmath>

namespace salma::laser {
namespace {

constexpr double kLevel = 0.985;  // cosine of 10 deg
constexpr double kFullTurn = 2 * M_PI + 1e-3;
constexpr std::size_t kFewReadings = 10;  // fewer may be equal by chance

bool usable(const mrpt::obs::CObservation2DRangeScan& scan, std::size_t i, double maxRange) {
    const double range = scan.getScanRange(i);
    return scan.getScanRangeValidity(i) && range > 0 && range <= maxRange && range < scan.maxRange;
}

/// All usable readings are the same: nothing that a wall could do.
bool isConstant(const mrpt::obs::CObservation2DRangeScan& scan, const std::vector<TBeam>& beams) {
    std::size_t usable = 0;
    float reading = 0;
    for (const TBeam& beam : beams) {
        if (!beam.valid()) continue;
        if (usable++ > 0 && scan.getScanRange(beam.index) != reading) return false;
        reading = scan.getScanRange(beam.index);
    }
    return usable >= kFewReadings;
}

}  // namespace

std::vector<TBeam> readBeams(const mrpt::obs::CObservation2DRangeScan& scan,
                             double maxRange,
                             TLineResult& result) {
    const auto R = scan.sensorPose.getRotationMatrix();
    const std::size_t n = scan.getScanSize();
    result.sensor = {scan.sensorPose.x(), scan.sensorPose.y()};
    result.beamStep = n > 1 ? scan.aperture / static_cast<double>(n - 1) : 0.0;
    result.tilted = !(std::abs(R(2, 2)) >= kLevel);
    std::vector<TBeam> beams;
    const double place = scan.sensorPose.x() + scan.sensorPose.y();
    result.badGeometry =
        n > 1 && !(scan.aperture > 0 && scan.aperture <= kFullTurn && std::isfinite(place));
    if (result.tilted || result.badGeometry) return beams;
    beams.reserve(n);
    const double turn = scan.rightToLeft ? 1 : -1;
    // Each direction is the one before, turned: the sum of all rounding stays below 1e-13.
    const double stepCosine = std::cos(result.beamStep),
                 stepSine = turn * std::sin(result.beamStep);
    double c = std::cos(0.5 * scan.aperture), s = -turn * std::sin(0.5 * scan.aperture);
    for (std::size_t i = 0; i < n; ++i) {
        const double dx = R(0, 0) * c + R(0, 1) * s;
        const double dy = R(1, 0) * c + R(1, 1) * s;
        const double level = std::sqrt(dx * dx + dy * dy);
        TBeam beam{dx / level, dy / level, 0, 0, 0, i};
        if (usable(scan, i, maxRange)) {
            beam.range = scan.getScanRange(i) * level;
            beam.x = beam.range * beam.cosine;
            beam.y = beam.range * beam.sine;
            ++result.validPoints;
        } else {
            ++result.invalidPoints;
        }
        beams.push_back(beam);
        const double turned = c * stepCosine - s * stepSine;
        s = s * stepCosine + c * stepSine;
        c = turned;
    }
    result.constant = isConstant(scan, beams);
    if (result.constant) beams.clear();
    if (turn * R(2, 2) < 0) std::reverse(beams.begin(), beams.end());
    return beams;
}

}  // namespace salma::laser
