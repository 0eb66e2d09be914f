// SPDX-License-Identifier: BSD-3-Clause
#include <salma/laser/CLineExtractor.h>

#include <algorithm>
#include <cmath>

#include "CLineSearch.h"

namespace salma::laser {
namespace {

constexpr double kEndSigmas = 3;  // at a line's ends, where another wall begins
constexpr double kEndRoughness = 0.01;
constexpr double kDepth = 0.06;  // a beam that goes on so far behind a wall has passed its edge [m]
constexpr int kEdgeBeams = 4;    // within so many beams: some meet the edge's own face

/// Drops end points that rather belong to a neighbouring wall, and fits what is left.
bool finish(const CFreePoints& points, TFit& fit, Members& members) {
    const auto alien = [&](std::size_t i) {
        const double d = fit.distance(points[i]);
        const double limit2 =
            std::max(kEndRoughness * kEndRoughness,
                     kEndSigmas * kEndSigmas * fit.variance(points[i], points.noise()));
        return d * d > limit2;
    };
    while (!members.empty() && alien(members.back())) members.pop_back();
    members.erase(members.begin(), std::find_if_not(members.begin(), members.end(), alien));
    if (members.size() < 3) return false;
    const auto last = refineLine(fit, points.beams(), members, points.noise());
    if (last) fit = *last;
    return last.has_value();
}

TBeamNoise noiseOf(const TLineOptions& options, const mrpt::obs::CObservation2DRangeScan& scan) {
    const double rounding = options.rangeQuantum / std::sqrt(12.0);  // of a uniform error
    const double sigma = std::hypot(options.rangeSigma, rounding);
    return {std::max<double>(sigma, scan.stdError), options.bearingSigma};
}

TLine asLine(const TFit& fit, const std::vector<TBeam>& beams, const Members& members) {
    TLine line;
    line.rho = fit.rho;
    line.alpha = std::atan2(fit.sine, fit.cosine);
    line.covariance = fit.covariance;
    const auto foot = [&](std::size_t i) {
        const double t = fit.along(beams[i]);
        return mrpt::math::TPoint2D(fit.rho * fit.cosine - t * fit.sine,
                                    fit.rho * fit.sine + t * fit.cosine);
    };
    line.from = foot(members.front());
    line.to = foot(members.back());
    const std::size_t a = beams[members.front()].index;
    const std::size_t b = beams[members.back()].index;
    line.firstPoint = std::min(a, b);
    line.lastPoint = std::max(a, b);
    line.points = members.size();
    return line;
}

/** True if the wall itself ends at a beam: those after it meet something behind the wall, and
 * nothing before it that could hide the rest. */
bool isEdge(const TFit& fit, const std::vector<TBeam>& beams, std::size_t last, int direction) {
    for (int k = 1; k <= kEdgeBeams; ++k) {
        const std::size_t i = last + static_cast<std::size_t>(k * direction);  // wraps below 0
        if (i >= beams.size() || !beams[i].valid()) return false;
        const double behind = fit.distance(beams[i]);
        if (behind < -kDepth) return false;
        if (behind > kDepth) return true;
    }
    return false;
}

}  // namespace

void TLineOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.choice("method", method,
             {{"ransac", ELineMethod::ransac}, {"split_merge", ELineMethod::splitMerge}},
             "how the lines are found");
    v.number("inlier_m", inlier, moreThan(0), "points this near belong to a line");
    v.number("gap_m", gap, moreThan(0), "a hole longer than this along a line splits it");
    v.number("min_length_m", minLength, moreThan(0), "shorter pieces are refused");
    v.integer("min_points", minPoints, atLeast(3), "pieces with fewer points are refused");
    v.integer("hypotheses", hypotheses, between(1, 100000), "RANSAC samples of a scan");
    v.integer("window", window, between(2, 1000), "beams between the two points of a sample");
    v.number("max_range_m", maxRange, moreThan(0), "longer ranges are not used");
    v.number("range_sigma_m", rangeSigma, moreThan(0),
             "noise of a range; the record's own sigma counts if it is larger");
    v.number("range_quantum_m", rangeQuantum, atLeast(0), "step in which ranges are rounded");
    v.degrees("bearing_sigma_deg", bearingSigma, atLeast(0), "noise of a beam's direction");
    v.integer("seed", seed, atLeast(0), "of the RANSAC samples");
}

CLineExtractor::CLineExtractor(const TLineOptions& options) : m_options(options) {
    m_options.validate();
}

TLineResult CLineExtractor::extract(const mrpt::obs::CObservation2DRangeScan& scan) const {
    TLineResult result;
    const std::vector<TBeam> beams = readBeams(scan, m_options.maxRange, result);
    const TBeamNoise noise = noiseOf(m_options, scan);
    result.rangeSigma = noise.range;
    result.bearingSigma = noise.bearing;
    CFreePoints points(m_options, beams, noise);
    const auto search = createLineSearch(m_options, points);
    const mrpt::poses::CPose2D T_r_s(result.sensor.x, result.sensor.y, 0);
    result.loosePoints = result.validPoints;
    struct TFound {
        std::size_t first;
        TLine line;
        TFreeEnds ends;
    };
    std::vector<TFound> found;
    for (TCandidate run = search->next(); !run.members.empty(); run = search->next()) {
        TFit fit = run.fit;
        Members members = run.members;
        const bool fitted = finish(points, fit, members);
        if (!fitted || members.size() < static_cast<std::size_t>(m_options.minPoints)) {
            ++result.refusedPoints;
            points.take(run.members);
            continue;
        }
        const TLine line = asLine(fit, beams, members);
        points.take(members);
        if (!(line.length() >= m_options.minLength)) {
            ++result.refusedShort;
            continue;
        }
        result.loosePoints -= members.size();
        const TFreeEnds ends{isEdge(fit, beams, members.front(), -1),
                             isEdge(fit, beams, members.back(), 1)};
        found.push_back({members.front(), transformed(line, T_r_s), ends});
    }
    std::sort(found.begin(), found.end(),
              [](const TFound& a, const TFound& b) { return a.first < b.first; });
    for (const TFound& f : found) {
        result.lines.push_back(f.line);
        result.freeEnds.push_back(f.ends);
    }
    return result;
}

}  // namespace salma::laser
