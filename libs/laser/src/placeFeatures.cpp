// SPDX-License-Identifier: BSD-3-Clause
#include "placeFeatures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "beams.h"

namespace salma::laser {
namespace {

constexpr double kFar = 8;         // what is farther, or gives no echo, counts as this [m]
constexpr double kUnseen = -0.25;  // in place of a distance outside the field of view
constexpr double kMinField = M_PI - 0.05;
constexpr double kMinValid = 0.25;  // share of the readings

constexpr std::size_t kStations = 26;  // along the robot's way ...
constexpr double kStationStep = 0.25;  // ... so far apart [m]
constexpr std::size_t kDepths = 40;    // to either side of it ...
constexpr double kDepthStep = 0.1;     // [m]
constexpr std::size_t kSectors = 44;
constexpr double kSector = M_PI / 36;
constexpr double kHalf = 2;  // ranges enter as r / (r + this) [m]

constexpr std::size_t kFeatures = 2 * kStations + kSectors + 1;

/// Ranges by bearing, evenly spaced and without holes.
struct TRanges {
    double first{0}, step{0};  //!< Bearing of the first, and between neighbours [rad].
    std::vector<double> r;     //!< [m]

    /// The range in a direction; negative outside the field of view.
    double at(double bearing) const {
        const double k = std::round((bearing - first) / step);
        if (!(k >= 0 && k < static_cast<double>(r.size()))) return -1;
        return r[static_cast<std::size_t>(k)];
    }
};

std::optional<TRanges> readRanges(const mrpt::obs::CObservation2DRangeScan& scan) {
    TLineResult counts;
    const std::vector<TBeam> beams = readBeams(scan, kFar, counts);
    if (beams.size() < 2 || !(std::abs(scan.aperture) >= kMinField)) return std::nullopt;
    std::size_t valid = 0;
    for (std::size_t i = 0; i < scan.getScanSize(); ++i)
        if (scan.getScanRangeValidity(i) && scan.getScanRange(i) > 0 &&
            std::isfinite(scan.getScanRange(i)))
            ++valid;
    if (!(static_cast<double>(valid) >= kMinValid * static_cast<double>(beams.size())))
        return std::nullopt;
    TRanges ranges;
    ranges.step = counts.beamStep;
    ranges.first = std::atan2(beams.front().sine, beams.front().cosine);
    std::vector<double> raw;
    for (const TBeam& beam : beams) raw.push_back(beam.valid() ? beam.range : kFar);
    ranges.r = raw;  // the median of three drops single echoes from between two edges
    for (std::size_t i = 1; i + 1 < raw.size(); ++i)
        ranges.r[i] = std::max(std::min(raw[i - 1], raw[i]),
                               std::min(std::max(raw[i - 1], raw[i]), raw[i + 1]));
    return ranges;
}

/// Direction of the walls, the one within 45 deg of the robot's own [rad].
double wallDirection(const TRanges& ranges) {
    constexpr std::size_t kSpan = 6;
    constexpr double kStraight = 0.02;
    double c = 0, s = 0;
    const auto point = [&](std::size_t i) {
        const double bearing = ranges.first + static_cast<double>(i) * ranges.step;
        return std::array<double, 2>{ranges.r[i] * std::cos(bearing),
                                     ranges.r[i] * std::sin(bearing)};
    };
    for (std::size_t i = 0; i + kSpan < ranges.r.size(); i += 2) {
        if (ranges.r[i] >= kFar || ranges.r[i + kSpan] >= kFar) continue;
        const auto a = point(i), m = point(i + kSpan / 2), b = point(i + kSpan);
        const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
        const double off = std::abs((m[0] - a[0]) * dy - (m[1] - a[1]) * dx) / length;
        if (!(length < 1.5 && off < kStraight)) continue;
        // four times the angle: walls at right angles say the same
        const double cc = dx / length, ss = dy / length;
        const double c2 = cc * cc - ss * ss, s2 = 2 * cc * ss;
        c += length * (c2 * c2 - s2 * s2);
        s += length * 2 * c2 * s2;
    }
    return std::atan2(s, c) / 4;
}

/// How far the view is free to one side of the robot's way, by distance along it.
void addProfile(const TRanges& ranges, double turn, double side, std::vector<float>& features) {
    for (std::size_t i = 0; i < kStations; ++i) {
        const double x = static_cast<double>(i) * kStationStep;
        double depth = kUnseen;
        for (std::size_t k = i == 0 ? 1 : 0; k <= kDepths; ++k) {
            const double y = static_cast<double>(k) * kDepthStep;
            const double range = ranges.at(std::atan2(side * y, x) + turn);
            if (range < 0) break;
            depth = std::max(depth, 0.0);
            if (range < std::hypot(x, y)) break;
            depth = y / (kDepthStep * kDepths);
        }
        features.push_back(static_cast<float>(depth));
    }
}

void addSectors(const TRanges& ranges, double turn, std::vector<float>& features) {
    std::array<double, kSectors> nearest;
    nearest.fill(2 * kFar);
    for (std::size_t i = 0; i < ranges.r.size(); ++i) {
        const double bearing = ranges.first + static_cast<double>(i) * ranges.step - turn;
        const double k = std::floor(bearing / kSector) + kSectors / 2.0;
        if (!(k >= 0 && k < kSectors)) continue;
        double& r = nearest[static_cast<std::size_t>(k)];
        r = std::min(r, ranges.r[i]);
    }
    for (const double r : nearest)
        features.push_back(static_cast<float>(r > kFar ? kUnseen : r / (r + kHalf)));
}

}  // namespace

std::size_t numberOfPlaceFeatures() { return kFeatures; }

std::optional<Eigen::VectorXf> placeFeatures(const mrpt::obs::CObservation2DRangeScan& scan) {
    const auto ranges = readRanges(scan);
    if (!ranges) return std::nullopt;
    const double turn = wallDirection(*ranges);
    std::vector<float> features;
    features.reserve(kFeatures);
    addProfile(*ranges, turn, 1, features);
    addProfile(*ranges, turn, -1, features);
    addSectors(*ranges, turn, features);
    features.push_back(static_cast<float>(turn));
    return Eigen::Map<const Eigen::VectorXf>(features.data(),
                                             static_cast<Eigen::Index>(features.size()));
}

Eigen::VectorXf mirroredFeatures(const Eigen::VectorXf& features) {
    constexpr auto stations = static_cast<Eigen::Index>(kStations);
    constexpr auto sectors = static_cast<Eigen::Index>(kSectors);
    Eigen::VectorXf result = features;
    result.head(stations) = features.segment(stations, stations);
    result.segment(stations, stations) = features.head(stations);
    result.segment(2 * stations, sectors) = features.segment(2 * stations, sectors).reverse();
    result(result.size() - 1) = -features(features.size() - 1);
    return result;
}

}  // namespace salma::laser
