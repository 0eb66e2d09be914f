// SPDX-License-Identifier: BSD-3-Clause
#include "CAgreement.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

namespace salma::appearance {
namespace {

constexpr double kKeypointSlack = 2;  // one keypoint's scale and angle vary more than the patch's
constexpr int kRefinements = 3;

}  // namespace

/// Pairs whose own scale and angle fit metric, upright patches.
KeypointPairs CAgreement::upright(const KeypointPairs& pairs) const {
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
KeypointPairs CAgreement::following(const TSimilarity& s, const KeypointPairs& pairs) const {
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
TSimilarity CAgreement::commonShift(const KeypointPairs& pairs) const {
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

bool CAgreement::nearIdentity(const TSimilarity& s) const {
    return std::abs(std::log(s.scale)) <= std::log(m_options.scaleTolerance) &&
           std::abs(s.rotation) <= m_options.rotationTolerance;
}

std::vector<TPointPair> CAgreement::points(const KeypointPairs& pairs) const {
    std::vector<TPointPair> out;
    out.reserve(pairs.size());
    for (const auto& p : pairs)
        out.push_back({m_a[p.first].x, m_a[p.first].y, m_b[p.second].x, m_b[p.second].y});
    return out;
}

KeypointPairs CAgreement::agreeing(const KeypointPairs& putative) const {
    const auto candidates = upright(putative);
    auto pairs = following(commonShift(candidates), candidates);
    for (int i = 0; i < kRefinements && pairs.size() >= 3; ++i) {
        const auto refined = fitSimilarity(points(pairs));
        if (!refined || !nearIdentity(*refined)) break;
        auto more = following(*refined, candidates);
        if (more.size() < pairs.size()) break;
        pairs = std::move(more);
    }
    return pairs;
}

}  // namespace salma::appearance
