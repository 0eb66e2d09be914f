// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/viz/CTrajectoryScore.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace salma::viz {
namespace {

using mrpt::poses::CPose2D;

constexpr double kStampTolerance = 1e-6;  // files hold 6 decimals

class CErrorSum {
 public:
    void add(double error) {
        m_squares += error * error;
        m_sum += error;
        m_max = std::max(m_max, error);
        ++m_count;
    }

    TErrorFigures figures() const {
        if (m_count == 0) return {};
        const double n = static_cast<double>(m_count);
        return {std::sqrt(m_squares / n), m_sum / n, m_max, m_count};
    }

 private:
    double m_squares{0}, m_sum{0}, m_max{0};
    std::size_t m_count{0};
};

/// Poses with one stamp; equal indices belong together.
struct TPairs {
    std::vector<double> times;
    std::vector<CPose2D> reference, estimate;
};

TPairs pairUp(const TTrajectory& reference, const TTrajectory& estimate, double maxGap) {
    TPairs pairs;
    for (const auto& [time, pose] : estimate) {
        CPose2D there;
        if (!interpolate(reference, time, maxGap, there)) continue;
        pairs.times.push_back(time);
        pairs.reference.push_back(there);
        pairs.estimate.push_back(pose);
    }
    return pairs;
}

std::vector<double> pathLength(const std::vector<CPose2D>& path) {
    std::vector<double> length(path.size(), 0);
    for (std::size_t i = 1; i < path.size(); ++i)
        length[i] = length[i - 1] + path[i].distanceTo(path[i - 1]);
    return length;
}

/// \param position Of each pair on the axis along which `delta` counts; does not decrease.
TRelativeError relativeError(const TPairs& pairs,
                             const std::vector<double>& position,
                             double delta) {
    CErrorSum translation, rotation;
    std::size_t j = 0;
    for (std::size_t i = 0; i < position.size(); ++i) {
        // a micrometre or microsecond of rounding shall not cost a whole step
        while (j < position.size() && position[j] - position[i] < delta - 1e-6) ++j;
        if (j == position.size()) break;
        const CPose2D error =
            (pairs.estimate[j] - pairs.estimate[i]) - (pairs.reference[j] - pairs.reference[i]);
        translation.add(error.norm());
        rotation.add(std::abs(mrpt::math::wrapToPi(error.phi())));
    }
    return {translation.figures(), rotation.figures()};
}

void requirePositive(const std::string& key, double value) {
    if (!(value > 0 && std::isfinite(value)))
        throw std::invalid_argument(key + " = " + std::to_string(value) + " must be in (0, inf)");
}

}  // namespace

void TScoreOptions::visit(config::COptionVisitor& v) {
    v.number("max_gap_s", maxGap, config::moreThan(0),
             "longest gap between two reference poses that is interpolated over");
    v.number("delta_m", deltaMetres, config::moreThan(0),
             "distance on the reference that relative errors span");
    v.number("delta_s", deltaSeconds, config::moreThan(0), "time that relative errors span");
}

void TScoreOptions::validate() const {
    requirePositive("max_gap_s", maxGap);
    requirePositive("delta_m", deltaMetres);
    requirePositive("delta_s", deltaSeconds);
}

bool interpolate(const TTrajectory& trajectory, double t, double maxGap, CPose2D& pose) {
    const auto after = std::upper_bound(trajectory.begin(), trajectory.end(), t,
                                        [](double time, const auto& p) { return time < p.time; });
    if (after != trajectory.begin() && t - std::prev(after)->time <= kStampTolerance) {
        pose = std::prev(after)->T_w_r;
        return true;
    }
    if (after != trajectory.end() && after->time - t <= kStampTolerance) {
        pose = after->T_w_r;
        return true;
    }
    if (after == trajectory.begin() || after == trajectory.end()) return false;
    const auto& [time0, a] = *std::prev(after);
    const auto& [time1, b] = *after;
    if (!(time1 - time0 <= maxGap)) return false;
    const double w = (t - time0) / (time1 - time0);
    pose = CPose2D(a.x() + w * (b.x() - a.x()), a.y() + w * (b.y() - a.y()),
                   a.phi() + w * mrpt::math::wrapToPi(b.phi() - a.phi()));
    return true;
}

CPose2D alignment(const std::vector<CPose2D>& from, const std::vector<CPose2D>& to) {
    if (from.size() != to.size() || from.empty())
        throw std::invalid_argument("alignment needs equally many poses, at least one");
    const double n = static_cast<double>(from.size());
    double fx = 0, fy = 0, tx = 0, ty = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        fx += from[i].x() / n;
        fy += from[i].y() / n;
        tx += to[i].x() / n;
        ty += to[i].y() / n;
    }
    double dot = 0, cross = 0;  // in a plane Umeyama's SVD is one angle
    for (std::size_t i = 0; i < from.size(); ++i) {
        const double ax = from[i].x() - fx, ay = from[i].y() - fy;
        const double bx = to[i].x() - tx, by = to[i].y() - ty;
        dot += ax * bx + ay * by;
        cross += ax * by - ay * bx;
    }
    const double angle = std::atan2(cross, dot);
    return {tx - std::cos(angle) * fx + std::sin(angle) * fy,
            ty - std::sin(angle) * fx - std::cos(angle) * fy, angle};
}

CTrajectoryScore::CTrajectoryScore(const TScoreOptions& options) : m_options(options) {
    m_options.validate();
}

TTrajectoryFigures CTrajectoryScore::compare(const TTrajectory& reference,
                                             const TTrajectory& estimate) const {
    const TPairs pairs = pairUp(reference, estimate, m_options.maxGap);
    const std::size_t n = pairs.times.size();
    if (n < 2)
        throw std::invalid_argument(std::to_string(n) + " of " + std::to_string(estimate.size()) +
                                    " estimated poses have a reference pose at their time; at "
                                    "least 2 are needed");
    TTrajectoryFigures figures;
    figures.pairs = n;
    figures.unmatched = estimate.size() - n;
    figures.T_ref_est = alignment(pairs.estimate, pairs.reference);
    CErrorSum aligned, unaligned, heading;
    for (std::size_t i = 0; i < n; ++i) {
        const CPose2D moved = figures.T_ref_est + pairs.estimate[i];
        aligned.add(moved.distanceTo(pairs.reference[i]));
        unaligned.add(pairs.estimate[i].distanceTo(pairs.reference[i]));
        heading.add(std::abs(mrpt::math::wrapToPi(moved.phi() - pairs.reference[i].phi())));
    }
    figures.aligned = aligned.figures();
    figures.unaligned = unaligned.figures();
    figures.alignedHeading = heading.figures();
    const auto metres = pathLength(pairs.reference);
    figures.referenceLength = metres.back();
    figures.perMetres = relativeError(pairs, metres, m_options.deltaMetres);
    figures.perTime = relativeError(pairs, pairs.times, m_options.deltaSeconds);
    return figures;
}

}  // namespace salma::viz
