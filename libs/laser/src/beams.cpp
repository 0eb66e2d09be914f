// SPDX-License-Identifier: BSD-3-Clause
#include "beams.h"

#include <algorithm>
#include <cmath>

namespace salma::laser {
namespace {

constexpr double kLevel = 0.985;  // cosine of 10 deg

bool usable(const mrpt::obs::CObservation2DRangeScan& scan, std::size_t i, double maxRange) {
    const double range = scan.getScanRange(i);
    return scan.getScanRangeValidity(i) && range > 0 && range <= maxRange && range < scan.maxRange;
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
    if (result.tilted) return beams;
    const double turn = scan.rightToLeft ? 1 : -1;
    for (std::size_t i = 0; i < n; ++i) {
        const double bearing =
            turn * (static_cast<double>(i) * result.beamStep - 0.5 * scan.aperture);
        const double c = std::cos(bearing);
        const double s = std::sin(bearing);
        const double dx = R(0, 0) * c + R(0, 1) * s;
        const double dy = R(1, 0) * c + R(1, 1) * s;
        const double level = std::hypot(dx, dy);
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
    }
    if (turn * R(2, 2) < 0) std::reverse(beams.begin(), beams.end());
    return beams;
}

}  // namespace salma::laser
