// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/CPatchMatcher.h>

#include <algorithm>
#include <cmath>

#include "likelihoodTable.h"
#include "matchKeypoints.h"

namespace salma::appearance {
namespace {

using Keypoints = std::vector<observations::TKeypoint>;

constexpr double kKeypointSlack = 2;  // one keypoint's scale and angle vary more than the patch's
constexpr int kRefinements = 3;

/// Two sets of keypoints, and the pairs that may agree.
class CAgreement {
 public:
    CAgreement(const TMatcherOptions& options, const Keypoints& a, const Keypoints& b)
        : m_options(options), m_a(a), m_b(b) {}

    /// Pairs whose own scale and angle fit metric, upright patches.
    KeypointPairs upright(const KeypointPairs& pairs) const {
        const double scale = kKeypointSlack * std::log(m_options.scaleTolerance);
        const double turn = kKeypointSlack * m_options.rotationTolerance;
        KeypointPairs kept;
        for (const auto& p : pairs) {
            const auto& a = m_a[p.first];
            const auto& b = m_b[p.second];
            if (std::abs(std::log(b.scale / a.scale)) <= scale &&
                std::abs(mrpt::math::wrapToPi(b.angle - a.angle)) <= turn)
                kept.push_back(p);
        }
        return kept;
    }

    /// Pairs that the similarity maps onto each other.
    KeypointPairs following(const TSimilarity& s, const KeypointPairs& pairs) const {
        const double c = s.scale * std::cos(s.rotation);
        const double d = s.scale * std::sin(s.rotation);
        KeypointPairs kept;
        for (const auto& p : pairs) {
            const auto& a = m_a[p.first];
            const auto& b = m_b[p.second];
            const double x = c * a.x - d * a.y + s.tx;
            const double y = d * a.x + c * a.y + s.ty;
            if (std::hypot(b.x - x, b.y - y) <= m_options.positionTolerance) kept.push_back(p);
        }
        return kept;
    }

    /// The shift of one pair that most pairs share.
    TSimilarity commonShift(const KeypointPairs& pairs) const {
        TSimilarity best;
        std::size_t most = 0;
        for (const auto& p : pairs) {
            const TSimilarity shift{1, 0, m_b[p.second].x - m_a[p.first].x,
                                    m_b[p.second].y - m_a[p.first].y};
            const std::size_t n = following(shift, pairs).size();
            if (n <= most) continue;
            most = n;
            best = shift;
        }
        return best;
    }

    /// Least squares; false if the pairs do not determine it or it is not near upright.
    bool fit(const KeypointPairs& pairs, TSimilarity& s) const {
        double ax = 0, ay = 0, bx = 0, by = 0;
        for (const auto& p : pairs) {
            ax += m_a[p.first].x, ay += m_a[p.first].y;
            bx += m_b[p.second].x, by += m_b[p.second].y;
        }
        const auto n = static_cast<double>(pairs.size());
        ax /= n, ay /= n, bx /= n, by /= n;
        double dot = 0, cross = 0, spread = 0;
        for (const auto& p : pairs) {
            const double x = m_a[p.first].x - ax, y = m_a[p.first].y - ay;
            const double u = m_b[p.second].x - bx, v = m_b[p.second].y - by;
            dot += x * u + y * v;
            cross += x * v - y * u;
            spread += x * x + y * y;
        }
        if (!(spread > 0)) return false;
        TSimilarity fitted;
        fitted.scale = std::hypot(dot, cross) / spread;
        fitted.rotation = std::atan2(cross, dot);
        if (!(std::abs(std::log(fitted.scale)) <= std::log(m_options.scaleTolerance)) ||
            !(std::abs(fitted.rotation) <= m_options.rotationTolerance))
            return false;
        const double c = fitted.scale * std::cos(fitted.rotation);
        const double d = fitted.scale * std::sin(fitted.rotation);
        fitted.tx = bx - c * ax + d * ay;
        fitted.ty = by - d * ax - c * ay;
        s = fitted;
        return true;
    }

 private:
    const TMatcherOptions& m_options;
    const Keypoints& m_a;
    const Keypoints& m_b;
};

}  // namespace

void TMatcherOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.number("ratio", ratio, insideOf(0, 1), "nearest over second nearest descriptor distance");
    v.number("scale_tolerance", scaleTolerance, moreThan(1), "patches agree in scale within it");
    v.degrees("rotation_tolerance_deg", rotationTolerance, insideOf(0, 90),
              "patches agree in rotation within it");
    v.number("position_tolerance_m", positionTolerance, moreThan(0),
             "matches agree on the similarity within this");
    v.integer("min_matches", minMatches, atLeast(2), "fewer consistent matches score 0");
    v.integer("full_score_keypoints", fullScoreKeypoints, atLeast(1),
              "a patch with fewer keypoints cannot score 1");
    v.number("duplicate_rate", duplicateRate, insideOf(0, 1),
             "share of other entities that look the same");
    v.numbers("score_knots", scoreKnots, between(0, 1), "ascending scores of the table");
    v.numbers("log_lr_knots", logLrKnots, anyNumber(),
              "log p(score|same) / p(score|other) at each, measured on distinct posters");
}

void TMatcherOptions::validate() const { checkTable(scoreKnots, logLrKnots, "matcher"); }

CPatchMatcher::CPatchMatcher(const TMatcherOptions& options) : m_options(options) {
    m_options.validate();
}

double CPatchMatcher::logLikelihoodRatio(double score) const {
    const double table = readTable(m_options.scoreKnots, m_options.logLrKnots, score);
    return withDuplicates(table, m_options.duplicateRate);
}

TPatchMatch CPatchMatcher::match(const observations::TPatch& a,
                                 const observations::TPatch& b) const {
    TPatchMatch out;
    const auto least = static_cast<std::size_t>(m_options.minMatches);
    const std::size_t fewer = std::min(a.keypoints.size(), b.keypoints.size());
    if (fewer < least) return out;  // no evidence for or against
    const auto putative = matchKeypoints(a.keypoints, b.keypoints, m_options.ratio);
    out.putative = putative.size();
    const CAgreement agreement(m_options, a.keypoints, b.keypoints);
    const auto upright = agreement.upright(putative);
    out.similarity = agreement.commonShift(upright);
    out.pairs = agreement.following(out.similarity, upright);
    for (int i = 0; i < kRefinements && out.pairs.size() >= 3; ++i) {
        TSimilarity refined;
        if (!agreement.fit(out.pairs, refined)) break;
        auto more = agreement.following(refined, upright);
        if (more.size() < out.pairs.size()) break;
        out.similarity = refined;
        out.pairs = std::move(more);
    }
    out.consistent = out.pairs.size();
    if (out.consistent >= least) {
        const auto full = static_cast<std::size_t>(m_options.fullScoreKeypoints);
        out.score =
            static_cast<double>(out.consistent) / static_cast<double>(std::max(fewer, full));
    }
    out.logLikelihoodRatio = logLikelihoodRatio(out.score);
    return out;
}

}  // namespace salma::appearance
