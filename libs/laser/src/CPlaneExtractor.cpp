// SPDX-License-Identifier: BSD-3-Clause
#include <salma/laser/CPlaneExtractor.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "CPlaneSearch.h"

namespace salma::laser {
namespace {

using Eigen::Vector3d;
using mrpt::obs::CObservation2DRangeScan;

TLineOptions lineOptions(const TPlaneOptions& options) {
    TLineOptions lines;
    lines.minLength = options.minLength;
    lines.minPoints = 5;
    lines.rangeSigma = options.rangeSigma;
    lines.bearingSigma = options.bearingSigma;
    lines.seed = options.seed;
    return lines;
}

Vector3d inRobot(const mrpt::poses::CPose3D& pose, double x, double y) {
    Vector3d p;
    pose.composePoint(x, y, 0, p.x(), p.y(), p.z());
    return p;
}

void check(const CObservation2DRangeScan& scan, std::size_t number, std::size_t readings) {
    const auto& pose = scan.sensorPose;
    const double sum = pose.x() + pose.y() + pose.z() + pose.yaw() + pose.pitch() + pose.roll();
    const std::string name = "scan " + std::to_string(number) + " of the sweep ";
    if (!std::isfinite(sum)) throw std::invalid_argument(name + "has a pose that is not finite");
    if (scan.getScanSize() != readings)
        throw std::invalid_argument(name + "has " + std::to_string(scan.getScanSize()) +
                                    " readings, the first " + std::to_string(readings));
    if (readings > 1 && !(scan.aperture > 0 && scan.aperture <= 2 * M_PI + 1e-3))
        throw std::invalid_argument(name + "has an aperture of " + std::to_string(scan.aperture) +
                                    " rad");
}

/// The readings of a line, in space.
TSpaceLine inSpace(const TLine& line, const CObservation2DRangeScan& scan, double inlier) {
    TSpaceLine out;
    out.from = inRobot(scan.sensorPose, line.from.x, line.from.y);
    out.to = inRobot(scan.sensorPose, line.to.x, line.to.y);
    out.scanner = inRobot(scan.sensorPose, 0, 0);
    const double step = scan.aperture / static_cast<double>(scan.getScanSize() - 1);
    const double c = std::cos(line.alpha), s = std::sin(line.alpha);
    for (std::size_t i = line.firstPoint; i <= line.lastPoint; ++i) {
        const double bearing =
            (scan.rightToLeft ? 1 : -1) * (step * static_cast<double>(i) - 0.5 * scan.aperture);
        const double x = scan.getScanRange(i) * std::cos(bearing);
        const double y = scan.getScanRange(i) * std::sin(bearing);
        if (scan.getScanRangeValidity(i) && std::abs(x * c + y * s - line.rho) <= inlier)
            out.points.push_back(inRobot(scan.sensorPose, x, y));
    }
    return out;
}

bool isUpright(const TPlanePatch& plane, double tilt) {
    return std::abs(plane.normal.z()) <= std::sin(tilt);
}

/** Does the upright plane `back` stand close behind `front`, and rise above it? From near by a
 * sweep does not look over a heater: then the wall beside it counts. */
bool risesBehind(const TPlanePatch& back, const TPlanePatch& front, const TPlaneOptions& o) {
    if (!(back.normal.dot(front.normal) >= std::cos(2 * o.tilt))) return false;
    const double middle = 0.5 * (front.low.x() + front.high.x());
    const Vector3d p = front.distance * front.normal + middle * front.across;
    const double depth = back.distance - back.normal.dot(p);
    const double at = back.across.dot(p);
    return depth > o.inlier && depth <= o.behind && at >= back.low.x() - o.gap &&
           at <= back.high.x() + o.gap &&
           back.high.y() * back.up.z() >= front.high.y() * front.up.z() + o.above;
}

EPlaneKind kindOf(const TPlanePatch& plane,
                  const TPlaneResult& all,
                  double scannerHeight,
                  const TPlaneOptions& o) {
    if (std::abs(plane.normal.z()) >= std::cos(o.tilt))
        return plane.distance * plane.normal.z() < scannerHeight ? EPlaneKind::floor
                                                                 : EPlaneKind::ceiling;
    if (!isUpright(plane, o.tilt)) return EPlaneKind::other;
    const bool covered = std::any_of(all.planes.begin(), all.planes.end(), [&](const auto& back) {
        return isUpright(back, o.tilt) && risesBehind(back, plane, o);
    });
    return covered ? EPlaneKind::protrusion : EPlaneKind::wall;
}

}  // namespace

void TPlaneOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.number("inlier_m", inlier, moreThan(0), "both ends of a line on a plane are this near to it");
    v.number("gap_m", gap, moreThan(0), "lines farther apart belong to different pieces");
    v.number("min_length_m", minLength, moreThan(0), "shorter lines are not used");
    v.integer("min_lines", minLines, atLeast(2), "pieces with fewer lines are refused");
    v.integer("min_points", minPoints, atLeast(10), "pieces with fewer points are refused");
    v.number("min_size_m", minSize, atLeast(0), "narrower pieces are refused");
    v.integer("hypotheses", hypotheses, between(1, 100000), "RANSAC samples for each plane");
    v.integer("window", window, between(1, 1000), "scans between the two lines of a sample");
    v.degrees("tilt_deg", tilt, between(0.1, 40), "upright and level planes are so within this");
    v.number("behind_m", behind, moreThan(0), "a wall so close behind an upright plane");
    v.number("above_m", above, moreThan(0), "and so much higher makes it a protrusion");
    v.number("range_sigma_m", rangeSigma, moreThan(0), "noise of a range");
    v.degrees("bearing_sigma_deg", bearingSigma, atLeast(0), "noise of a beam's direction");
    v.integer("seed", seed, atLeast(0), "of the RANSAC samples");
}

CPlaneExtractor::CPlaneExtractor(const TPlaneOptions& options)
    : m_options((options.validate(), options)), m_lines(lineOptions(options)) {}

TPlaneResult CPlaneExtractor::extract(const std::vector<CObservation2DRangeScan>& scans) const {
    TPlaneResult result;
    std::vector<TSpaceLine> lines;
    for (std::size_t k = 0; k < scans.size(); ++k) {
        check(scans[k], k, scans.front().getScanSize());
        CObservation2DRangeScan level = scans[k];
        level.sensorPose = mrpt::poses::CPose3D();
        const TLineResult found = m_lines.extract(level);
        result.scansWithoutLines += found.lines.empty();
        for (const TLine& line : found.lines) {
            lines.push_back(inSpace(line, scans[k], m_options.inlier));
            lines.back().scan = k;
        }
    }
    result.lines = lines.size();
    CPlaneSearch search(m_options, lines);
    while (const auto plane = search.next()) result.planes.push_back(*plane);
    std::size_t used = 0;
    for (const TPlanePatch& plane : result.planes) used += plane.lines;
    result.looseLines = result.lines - used;
    std::stable_sort(result.planes.begin(), result.planes.end(),
                     [](const auto& a, const auto& b) { return a.points > b.points; });
    for (TPlanePatch& plane : result.planes)
        plane.kind = kindOf(plane, result, scans.front().sensorPose.z(), m_options);
    return result;
}

}  // namespace salma::laser
