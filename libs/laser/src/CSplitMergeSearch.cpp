// SPDX-License-Identifier: BSD-3-Clause
#include "CSplitMergeSearch.h"

#include <cmath>

namespace salma::laser {
namespace {

constexpr double kGrazing = 0.1736;  // sine of 10 deg: walls are seen at no smaller angle

Members membersOf(const std::vector<std::uint32_t>& order, std::size_t first, std::size_t last) {
    return {order.begin() + static_cast<std::ptrdiff_t>(first),
            order.begin() + static_cast<std::ptrdiff_t>(last) + 1};
}

}  // namespace

CSplitMergeSearch::CSplitMergeSearch(const TLineOptions& options, const CFreePoints& points)
    : m_options(options), m_points(points) {
    for (std::uint32_t i = 0; i < points.size(); ++i)
        if (points.isFree(i)) m_order.push_back(i);
    std::size_t first = 0;
    for (std::size_t k = 1; k <= m_order.size(); ++k) {
        if (k < m_order.size() && !isJump(m_order[k - 1], m_order[k])) continue;
        split({first, k - 1});
        first = k;
    }
    merge();
    std::reverse(m_pieces.begin(), m_pieces.end());
}

bool CSplitMergeSearch::isJump(std::uint32_t a, std::uint32_t b) const {
    const TBeam &p = m_points[a], &q = m_points[b];
    const double step = std::abs(p.cosine * q.sine - p.sine * q.cosine);
    const double slanting = std::min(p.range, q.range) * step / std::max(kGrazing - step, 0.01);
    const double limit = std::max(m_options.gap, slanting + 3 * m_points.noise().range);
    const double dx = q.x - p.x, dy = q.y - p.y;
    return !(dx * dx + dy * dy <= limit * limit);
}

void CSplitMergeSearch::split(const TPiece& piece) {
    if (piece.last - piece.first + 1 < static_cast<std::size_t>(m_options.minPoints)) return;
    const auto chord = lineThrough(m_points[m_order[piece.first]], m_points[m_order[piece.last]]);
    if (!chord) return;
    double farthest = 0;
    std::size_t where = piece.first;
    bool near = true;
    for (std::size_t k = piece.first + 1; k < piece.last; ++k) {
        near = near && m_points.fits(*chord, m_order[k]);
        const double d = std::abs(chord->distance(m_points[m_order[k]]));
        if (!(d > farthest)) continue;
        farthest = d;
        where = k;
    }
    if (near || where == piece.first) {
        m_pieces.push_back(piece);
        return;
    }
    split({piece.first, where});
    split({where, piece.last});
}

std::optional<TFit> CSplitMergeSearch::lineOf(const TPiece& piece) const {
    const auto chord = lineThrough(m_points[m_order[piece.first]], m_points[m_order[piece.last]]);
    if (!chord) return std::nullopt;
    const Members members = membersOf(m_order, piece.first, piece.last);
    const auto fit = improveLine(*chord, m_points.beams(), members, m_points.noise());
    if (!fit) return std::nullopt;
    for (const auto i : members)
        if (!m_points.fits(*fit, i)) return std::nullopt;
    return fit;
}

void CSplitMergeSearch::merge() {
    std::vector<TPiece> merged;
    for (const TPiece& piece : m_pieces) {
        if (!merged.empty() && piece.first <= merged.back().last + 1 &&
            !isJump(m_order[merged.back().last], m_order[piece.first]) &&
            lineOf({merged.back().first, piece.last}))
            merged.back().last = piece.last;
        else
            merged.push_back(piece);
    }
    m_pieces.swap(merged);
}

TCandidate CSplitMergeSearch::next() {
    while (!m_pieces.empty()) {
        const TPiece piece = m_pieces.back();
        m_pieces.pop_back();
        TCandidate candidate;
        for (std::size_t k = piece.first; k <= piece.last; ++k)
            if (m_points.isFree(m_order[k])) candidate.members.push_back(m_order[k]);
        if (candidate.members.size() < static_cast<std::size_t>(m_options.minPoints)) continue;
        const auto fit =
            lineThrough(m_points[candidate.members.front()], m_points[candidate.members.back()]);
        if (!fit) continue;
        candidate.fit = *fit;
        settle(m_points, candidate);
        return candidate;
    }
    return {};
}

}  // namespace salma::laser
