// SPDX-License-Identifier: BSD-3-Clause
#include "findSquares.h"

#include <salma/calibration/CHomography.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "fitEdge.h"

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;
/// Corners in the order of the contour: clockwise as one sees it.
using TQuad = std::array<TPoint2D, 4>;
/// Column and row of a square, from where the search began.
using TCell = std::pair<int, int>;

constexpr double kLeastArea = 40;  ///< [px^2] Smaller blobs are noise.

TPoint2D centreOf(const TQuad& q) { return (q[0] + q[1] + q[2] + q[3]) * 0.25; }

/// Each side as a line through its edge points, the corners as their intersections.
std::optional<TQuad> refined(const cv::Mat& grey, const TQuad& rough) {
    std::array<std::optional<TImageLine>, 4> sides;
    for (std::size_t i = 0; i < 4; ++i) {
        sides[i] = fitEdge(grey, rough[i], rough[(i + 1) % 4]);
        if (!sides[i]) return std::nullopt;
    }
    TQuad quad;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto corner = intersection(*sides[(i + 3) % 4], *sides[i]);
        if (!corner || std::hypot(corner->x - rough[i].x, corner->y - rough[i].y) > 4)
            return std::nullopt;
        quad[i] = *corner;
    }
    return quad;
}

std::vector<TQuad> darkQuads(const cv::Mat& grey) {
    cv::Mat smooth, dark;
    cv::GaussianBlur(grey, smooth, {0, 0}, 1);  // dithered and noisy pictures
    const int window = std::max(11, std::min(grey.cols, grey.rows) / 8) | 1;
    cv::adaptiveThreshold(smooth, dark, 255, cv::ADAPTIVE_THRESH_MEAN_C, cv::THRESH_BINARY_INV,
                          window, 12);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(dark, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    std::vector<TQuad> quads;
    for (const auto& contour : contours) {
        std::vector<cv::Point> corners;
        cv::approxPolyDP(contour, corners, 0.06 * cv::arcLength(contour, true), true);
        if (corners.size() != 4 || !cv::isContourConvex(corners) ||
            cv::contourArea(corners) < kLeastArea)
            continue;
        if (cv::contourArea(corners, true) < 0) std::reverse(corners.begin(), corners.end());
        TQuad rough;
        std::transform(corners.begin(), corners.end(), rough.begin(),
                       [](const cv::Point& p) { return TPoint2D(p.x, p.y); });
        if (const auto quad = refined(grey, rough)) quads.push_back(*quad);
    }
    return quads;
}

/// Where the diagonals meet: the picture of the square's centre.
TPoint2D middleOf(const TQuad& q) {
    const TPoint2D a = q[2] - q[0], b = q[3] - q[1], way = q[1] - q[0];
    return q[0] + a * ((way.x * b.y - way.y * b.x) / (a.x * b.y - a.y * b.x));
}

/// Begins with the corner that makes the first side look most like that of `model`.
void turnLike(const TQuad& model, TQuad& quad) {
    const TPoint2D side = model[1] - model[0];
    const auto along = [&](std::size_t i) {
        const TPoint2D own = quad[(i + 1) % 4] - quad[i];
        return own.x * side.x + own.y * side.y;
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < 4; ++i)
        if (along(i) > along(best)) best = i;
    std::rotate(quad.begin(), quad.begin() + static_cast<std::ptrdiff_t>(best), quad.end());
}

/// Squares next to each other, found from one of them outwards.
class CGridGrowth {
 public:
    CGridGrowth(std::vector<TQuad> quads, double step) : m_quads(std::move(quads)), m_step(step) {
        for (auto& quad : m_quads) turnLike({TPoint2D(0, 0), TPoint2D(1, 0)}, quad);
        m_used.resize(m_quads.size());
    }

    /// All that hang together with a square that no earlier call reached; empty if there is none.
    std::map<TCell, TQuad> next() {
        const auto seed = std::find(m_used.begin(), m_used.end(), false);
        std::map<TCell, TQuad> cells;
        if (seed == m_used.end()) return cells;
        *seed = true;
        cells[{0, 0}] = m_quads[static_cast<std::size_t>(seed - m_used.begin())];
        for (std::deque<TCell> open{{0, 0}}; !open.empty(); open.pop_front())
            for (const auto& [dx, dy] : {TCell{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                const TCell cell{open.front().first + dx, open.front().second + dy};
                if (cells.count(cell) > 0) continue;
                const auto quad = takeNeighbour(cells.at(open.front()), dx, dy);
                if (!quad) continue;
                cells[cell] = *quad;
                open.push_back(cell);
            }
        return cells;
    }

 private:
    std::optional<TQuad> takeNeighbour(const TQuad& quad, int dx, int dy) {
        const auto H =
            CHomography::through({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {quad.begin(), quad.end()});
        if (!H) return std::nullopt;
        const TPoint2D expected = H->map({0.5 + dx * m_step, 0.5 + dy * m_step});
        const TPoint2D here = centreOf(quad);
        double nearest = 0.3 * std::hypot(expected.x - here.x, expected.y - here.y);
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < m_quads.size(); ++i) {
            const TPoint2D miss = centreOf(m_quads[i]) - expected;
            if (m_used[i] || !(std::hypot(miss.x, miss.y) < nearest)) continue;
            nearest = std::hypot(miss.x, miss.y);
            found = i;
        }
        if (!found) return std::nullopt;
        m_used[*found] = true;
        turnLike(quad, m_quads[*found]);
        return m_quads[*found];
    }

    std::vector<TQuad> m_quads;
    double m_step;  //!< Distance of two squares in sides of one.
    std::vector<bool> m_used;
};

/// The cells in rows, if they are a whole board; columns and rows may have to be exchanged.
std::optional<std::vector<TPoint2D>> inOrder(const std::map<TCell, TQuad>& cells,
                                             const TBoard& board) {
    if (cells.size() != static_cast<std::size_t>(board.columns * board.rows)) return std::nullopt;
    TCell low = cells.begin()->first, high = low;
    for (const auto& [cell, quad] : cells) {
        low = {std::min(low.first, cell.first), std::min(low.second, cell.second)};
        high = {std::max(high.first, cell.first), std::max(high.second, cell.second)};
    }
    const int width = high.first - low.first + 1, height = high.second - low.second + 1;
    const bool upright = width == board.columns && height == board.rows;
    if (!upright && (width != board.rows || height != board.columns)) return std::nullopt;
    std::vector<TPoint2D> points;
    for (int r = 0; r < board.rows; ++r)
        for (int c = 0; c < board.columns; ++c) {
            // Lying on its side: columns run down the picture, rows to its left.
            const auto cell = cells.find(upright ? TCell{low.first + c, low.second + r}
                                                 : TCell{high.first - r, low.second + c});
            if (cell == cells.end()) return std::nullopt;
            points.push_back(middleOf(cell->second));
        }
    return points;
}

}  // namespace

std::optional<std::vector<TPoint2D>> findSquares(const cv::Mat& grey, const TBoard& board) {
    CGridGrowth growth(darkQuads(grey), (board.square + board.gap) / board.square);
    for (auto cells = growth.next(); !cells.empty(); cells = growth.next())
        if (auto points = inOrder(cells, board)) return points;
    return std::nullopt;
}

}  // namespace salma::calibration
