// SPDX-License-Identifier: BSD-3-Clause
#include <salma/laser/CLineExtractor.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fitLine.h"

namespace salma::laser {
namespace {

constexpr double kRoughness = 0.012;  // walls are no flatter than this [m]
constexpr double kSigmas = 4;         // points of a line lie within so many sigma, or kRoughness
constexpr double kEndSigmas = 3;      // at its ends, where another wall begins
constexpr double kEndRoughness = 0.01;
constexpr int kRegrowths = 6;
constexpr double kDepth = 0.06;  // a beam that goes on so far behind a wall has passed its edge [m]
constexpr int kEdgeBeams = 4;    // within so many beams: some meet the edge's own face

using Members = std::vector<std::size_t>;

/// The points of one scan, and which of them are still free.
class CSearch {
 public:
    CSearch(const TLineOptions& options, const std::vector<TBeam>& beams, const TBeamNoise& noise)
        : m_options(options), m_beams(beams), m_noise(noise), m_free(beams.size()) {
        for (std::size_t i = 0; i < beams.size(); ++i) m_free[i] = beams[i].valid();
        m_inlier = std::max(options.inlier, kSigmas * noise.range);
        m_random.seed(static_cast<std::uint32_t>(options.seed));
    }

    /// The run with most points, refined; empty if none has `min_points`.
    Members next(TFit& fit) {
        Members best = bestHypothesis(fit);
        if (best.size() < static_cast<std::size_t>(m_options.minPoints)) return {};
        for (int i = 0; i < kRegrowths; ++i) {
            const auto better = refineLine(fit, m_beams, best, m_noise);
            if (!better) break;
            Members regrown = grow(*better, best[best.size() / 2]);
            if (regrown.size() < best.size() / 2 || regrown.size() < 3) break;
            fit = *better;
            if (regrown == best) break;
            best.swap(regrown);
        }
        return best;
    }

    /// Drops end points that rather belong to a neighbouring wall, and fits what is left.
    bool finish(TFit& fit, Members& members) const {
        const auto alien = [&](std::size_t i) {
            const double limit =
                std::max(kEndRoughness, kEndSigmas * fit.sigma(m_beams[i], m_noise));
            return std::abs(fit.distance(m_beams[i])) > limit;
        };
        while (!members.empty() && alien(members.back())) members.pop_back();
        members.erase(members.begin(), std::find_if_not(members.begin(), members.end(), alien));
        if (members.size() < 3) return false;
        const auto last = refineLine(fit, m_beams, members, m_noise);
        if (last) fit = *last;
        return last.has_value();
    }

    void take(const Members& members) {
        for (const std::size_t i : members) m_free[i] = false;
    }

 private:
    Members bestHypothesis(TFit& fit) {
        Members candidates;
        for (std::size_t i = 0; i < m_free.size(); ++i)
            if (m_free[i]) candidates.push_back(i);
        Members best;
        double bestScore = 0;
        if (candidates.size() < static_cast<std::size_t>(m_options.minPoints)) return best;
        const auto samples = static_cast<std::size_t>(m_options.hypotheses);
        for (std::size_t h = 0; h < samples; ++h) {
            // strata: every part of the scan is asked
            const std::size_t i = candidates[h * candidates.size() / samples];
            const std::size_t j =
                i + 2 + m_random() % static_cast<std::uint32_t>(m_options.window - 1);
            if (j >= m_free.size() || !m_free[j]) continue;
            const auto hypothesis = lineThrough(m_beams[i], m_beams[j]);
            if (!hypothesis) continue;
            Members members = grow(*hypothesis, i);
            const double score = support(*hypothesis, members);
            if (!(score > bestScore)) continue;
            bestScore = score;
            best.swap(members);
            fit = *hypothesis;
        }
        return best;
    }

    /// The unbroken run of free points along the line around `seed`, in order.
    Members grow(const TFit& fit, std::size_t seed) const {
        Members members;
        extend(fit, seed, -1, members);
        std::reverse(members.begin(), members.end());
        if (fits(fit, seed)) members.push_back(seed);
        extend(fit, seed, 1, members);
        return members;
    }

    /// How far a point may lie off: less on walls seen at a slant, whose points are exact.
    double tolerance(const TFit& fit, std::size_t i) const {
        return std::min(m_inlier, std::max(kRoughness, kSigmas * fit.sigma(m_beams[i], m_noise)));
    }

    bool fits(const TFit& fit, std::size_t i) const {
        return m_free[i] && std::abs(fit.distance(m_beams[i])) <= tolerance(fit, i);
    }

    /// Number of points, each counting less the farther it lies off.
    double support(const TFit& fit, const Members& members) const {
        double sum = 0;
        for (const std::size_t i : members) {
            const double d = fit.distance(m_beams[i]) / tolerance(fit, i);
            sum += 1 - d * d;
        }
        return sum;
    }

    void extend(const TFit& fit, std::size_t seed, int step, Members& members) const {
        double last = fit.along(m_beams[seed]);
        std::size_t lastIndex = seed;
        for (std::size_t i = seed + step; i < m_beams.size(); i += step) {  // wraps below 0
            const TBeam& beam = m_beams[i];
            if (fits(fit, i)) {
                const double hole = std::abs(fit.along(beam) - last);
                const bool neighbours = i == lastIndex + step;
                // neighbouring beams on a slanting wall may lie far apart
                if (hole > m_options.gap * (neighbours ? 4 : 1)) return;
                last = fit.along(beam);
                lastIndex = i;
                members.push_back(i);
                continue;
            }
            // where this beam would have met the line
            const double facing = beam.cosine * fit.cosine + beam.sine * fit.sine;
            const double side = beam.sine * fit.cosine - beam.cosine * fit.sine;
            if (!(facing > 0.01) || std::abs(fit.rho * side / facing - last) > m_options.gap)
                return;
        }
    }

    const TLineOptions& m_options;
    const std::vector<TBeam>& m_beams;
    TBeamNoise m_noise;
    std::vector<char> m_free;
    double m_inlier{0};
    std::mt19937 m_random;
};

TBeamNoise noiseOf(const TLineOptions& options, const mrpt::obs::CObservation2DRangeScan& scan) {
    const double sigma = std::max<double>(options.rangeSigma, scan.stdError);
    const double rounding = options.rangeQuantum / std::sqrt(12.0);  // of a uniform error
    return {std::hypot(sigma, rounding), options.bearingSigma};
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
    v.number("inlier_m", inlier, moreThan(0), "points this near belong to a line");
    v.number("gap_m", gap, moreThan(0), "a hole longer than this along a line splits it");
    v.number("min_length_m", minLength, moreThan(0), "shorter pieces are refused");
    v.integer("min_points", minPoints, atLeast(3), "pieces with fewer points are refused");
    v.integer("hypotheses", hypotheses, between(1, 100000), "RANSAC samples for each line");
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
    CSearch search(m_options, beams, noiseOf(m_options, scan));
    const mrpt::poses::CPose2D T_r_s(result.sensor.x, result.sensor.y, 0);
    result.loosePoints = result.validPoints;
    struct TFound {
        std::size_t first;
        TLine line;
        TFreeEnds ends;
    };
    std::vector<TFound> found;
    TFit fit;
    for (Members run = search.next(fit); !run.empty(); run = search.next(fit)) {
        Members members = run;
        const bool fitted = search.finish(fit, members);
        if (!fitted || members.size() < static_cast<std::size_t>(m_options.minPoints)) {
            ++result.refusedPoints;
            search.take(run);
            continue;
        }
        const TLine line = asLine(fit, beams, members);
        search.take(members);
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
