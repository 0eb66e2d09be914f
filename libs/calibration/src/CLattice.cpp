// SPDX-License-Identifier: BSD-3-Clause
#include "CLattice.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;

constexpr double kStraight = 0.85;  ///< Cosine above which two sides of squares are of one line.

/// Ends of pieces this near to each other may be of one corner [px].
double reachOf(const TEdgePiece& piece) { return std::clamp(0.25 * piece.length(), 4.0, 12.0); }

double dot(const TPoint2D& a, const TPoint2D& b) { return a.x * b.x + a.y * b.y; }
TPoint2D unit(const TPoint2D& v) { return v * (1 / v.norm()); }

}  // namespace

/// A lattice while it grows.
struct CLattice::TGrowth {
    std::map<TNode, TPoint2D> nodes;
    std::array<std::map<TNode, std::size_t>, 2> pieces;
    std::vector<std::pair<std::size_t, TNode>> corners;
};

CLattice::CLattice(const std::vector<TEdgePiece>& pieces) {
    findCorners(pieces);
    join(pieces);
    std::vector<std::size_t> order(m_corners.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return m_joints[a].size() > m_joints[b].size();
    });
    std::vector<bool> reached(m_corners.size());
    for (const std::size_t seed : order) {
        if (reached[seed] || m_joints[seed].size() < 3) continue;
        auto growth = grow(seed, reached);
        if (growth.nodes.size() <= m_nodes.size()) continue;
        m_nodes = std::move(growth.nodes);
        m_pieces = std::move(growth.pieces);
    }
}

void CLattice::findCorners(const std::vector<TEdgePiece>& pieces) {
    std::vector<std::pair<TPoint2D, double>> sums;  // of intersections, and how many
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (std::size_t k = i + 1; k < pieces.size(); ++k) {
            const double reach = std::min(reachOf(pieces[i]), reachOf(pieces[k]));
            for (const auto& a : pieces[i].ends)
                for (const auto& b : pieces[k].ends) {
                    if ((a - b).norm() > 1.5 * reach) continue;
                    const double cross =
                        std::abs(pieces[i].line.normal.x * pieces[k].line.normal.y -
                                 pieces[i].line.normal.y * pieces[k].line.normal.x);
                    const auto corner = intersection(pieces[i].line, pieces[k].line);
                    if (!corner || cross < 0.35 || (*corner - a).norm() > reach ||
                        (*corner - b).norm() > reach)
                        continue;
                    const auto near = std::find_if(sums.begin(), sums.end(), [&](const auto& s) {
                        return (s.first * (1 / s.second) - *corner).norm() < reach;
                    });
                    if (near == sums.end())
                        sums.emplace_back(*corner, 1);
                    else
                        near->first = near->first + *corner, near->second += 1;
                }
        }
    for (const auto& [sum, count] : sums) m_corners.push_back(sum * (1 / count));
}

void CLattice::join(const std::vector<TEdgePiece>& pieces) {
    m_joints.resize(m_corners.size());
    const auto nearest = [&](const TPoint2D& end, double reach) {
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < m_corners.size(); ++i) {
            const double away = (m_corners[i] - end).norm();
            if (away < reach) found = i, reach = away;
        }
        return found;
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto a = nearest(pieces[i].ends[0], 1.5 * reachOf(pieces[i]));
        const auto b = nearest(pieces[i].ends[1], 1.5 * reachOf(pieces[i]));
        if (!a || !b || *a == *b) continue;
        m_joints[*a].push_back({*b, i});
        m_joints[*b].push_back({*a, i});
    }
}

CLattice::TGrowth CLattice::grow(std::size_t seed, std::vector<bool>& reached) const {
    /// A corner of the lattice, and its way to the next column and row [px].
    struct TOpen {
        std::size_t corner;
        TNode node;
        std::array<TPoint2D, 2> way;
    };
    const auto wayTo = [&](std::size_t from, std::size_t to) {
        return m_corners[to] - m_corners[from];
    };
    const TPoint2D first = wayTo(seed, m_joints[seed][0].corner);
    TPoint2D second(-first.y, first.x);
    double least = kStraight;
    for (const auto& joint : m_joints[seed]) {  // the side that is least along the first
        const TPoint2D way = wayTo(seed, joint.corner);
        const double along = std::abs(dot(unit(way), unit(first)));
        if (along < least) second = way, least = along;
    }
    if (first.x * second.y - first.y * second.x < 0) second = second * -1.0;
    TGrowth growth;
    growth.nodes[{0, 0}] = m_corners[seed];
    reached[seed] = true;
    std::deque<TOpen> open{{seed, {0, 0}, {first, second}}};
    for (; !open.empty(); open.pop_front()) {
        const TOpen here = open.front();
        for (const auto& joint : m_joints[here.corner]) {
            const TPoint2D way = wayTo(here.corner, joint.corner);
            for (std::size_t axis = 0; axis < 2; ++axis) {
                const double cosine = dot(unit(way), unit(here.way[axis]));
                const double ratio = way.norm() / here.way[axis].norm();
                if (std::abs(cosine) < kStraight || ratio < 0.55 || ratio > 1.8) continue;
                const int step = cosine > 0 ? 1 : -1;
                TNode node = here.node;
                (axis == 0 ? node.first : node.second) += step;
                const auto taken = growth.nodes.find(node);
                if (taken == growth.nodes.end() ? reached[joint.corner]
                                                : !(taken->second == m_corners[joint.corner]))
                    continue;  // a corner has one place, and a place one corner
                growth.pieces[axis][step > 0 ? here.node : node] = joint.piece;
                if (taken != growth.nodes.end()) continue;
                growth.nodes[node] = m_corners[joint.corner];
                reached[joint.corner] = true;
                auto next = here.way;
                next[axis] = way * static_cast<double>(step);
                open.push_back({joint.corner, node, next});
            }
        }
    }
    return growth;
}

}  // namespace salma::calibration
