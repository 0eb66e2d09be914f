// SPDX-License-Identifier: BSD-3-Clause
#include "edgePieces.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;
using TChain = std::vector<cv::Point>;

/// Neighbours at the sides come before those at the corners.
constexpr int kSteps[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

TPoint2D asPoint(const cv::Point& p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y)};
}

/// Follows edge pixels that no chain has yet.
class CLinker {
 public:
    explicit CLinker(const cv::Mat& edges) {
        cv::copyMakeBorder(edges, m_left, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
    }

    std::vector<TChain> run() {
        std::vector<TChain> chains;
        for (const bool fromEnds : {true, false})  // then closed curves
            for (int v = 1; v + 1 < m_left.rows; ++v)
                for (int u = 1; u + 1 < m_left.cols; ++u)
                    if (m_left.at<unsigned char>(v, u) != 0 && (!fromEnds || neighbours(u, v) == 1))
                        chains.push_back(follow({u, v}));
        return chains;
    }

 private:
    int neighbours(int u, int v) const {
        int count = 0;
        for (const auto& s : kSteps)
            count += m_left.at<unsigned char>(v + s[1], u + s[0]) != 0 ? 1 : 0;
        return count;
    }

    TChain follow(cv::Point at) {
        TChain chain;
        for (bool more = true; more;) {
            chain.emplace_back(at.x - 1, at.y - 1);
            m_left.at<unsigned char>(at) = 0;
            more = false;
            for (const auto& s : kSteps) {
                const cv::Point next(at.x + s[0], at.y + s[1]);
                if (m_left.at<unsigned char>(next) == 0) continue;
                at = next;
                more = true;
                break;
            }
        }
        return chain;
    }

    cv::Mat m_left;
};

/// Index of the point farthest from the chord; its distance.
std::pair<std::size_t, double> farthest(const TChain& chain, std::size_t from, std::size_t to) {
    const TPoint2D a = asPoint(chain[from]), b = asPoint(chain[to]);
    const double length = (b - a).norm();
    std::pair<std::size_t, double> most{from, 0};
    for (std::size_t i = from + 1; i < to; ++i) {
        const TPoint2D p = asPoint(chain[i]) - a;
        const double away = length > 1 ? std::abs(p.x * (b.y - a.y) - p.y * (b.x - a.x)) / length
                                       : p.norm();  // a closed curve
        if (away > most.second) most = {i, away};
    }
    return most;
}

void cut(const TChain& chain,
         std::size_t from,
         std::size_t to,
         double bend,
         double minLength,
         std::vector<TEdgePiece>& pieces) {
    const auto [middle, away] = farthest(chain, from, to);
    if (away > bend) {
        cut(chain, from, middle, bend, minLength, pieces);
        cut(chain, middle, to, bend, minLength, pieces);
        return;
    }
    TEdgePiece piece;
    piece.ends[0] = asPoint(chain[from]);
    piece.ends[1] = asPoint(chain[to]);
    if (piece.length() < minLength) return;
    const std::size_t margin = (to - from) / 8;  // corners are round
    for (std::size_t i = from + margin; i + margin <= to; ++i)
        piece.points.push_back(asPoint(chain[i]));
    const auto line = fitLine(piece.points);
    if (!line) return;
    piece.line = *line;
    pieces.push_back(std::move(piece));
}

}  // namespace

std::vector<TChain> linkEdges(const cv::Mat& edges) { return CLinker(edges).run(); }

std::vector<TEdgePiece> straightPieces(const std::vector<TChain>& chains,
                                       double bend,
                                       double minLength) {
    std::vector<TEdgePiece> pieces;
    for (const auto& chain : chains)
        if (static_cast<double>(chain.size()) >= minLength)
            cut(chain, 0, chain.size() - 1, bend, minLength, pieces);
    return pieces;
}

}  // namespace salma::calibration
