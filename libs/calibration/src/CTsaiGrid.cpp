// SPDX-License-Identifier: BSD-3-Clause
#include <salma/calibration/CHomography.h>
#include <salma/calibration/CTsaiGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "CLattice.h"

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

/// Two boards leave so many times more if they are taken for one.
constexpr double kFolded = 4;
/// An intersection this far from where pieces met is of other lines [px].
constexpr double kFarthest = 8;

/// The lattice cut at one of its lines, the fold, whose own corners are not used.
class CFoldedLattice {
 public:
    /// \param axis 0: the fold is a row; 1: a column.
    CFoldedLattice(const CLattice& lattice,
                   const std::vector<TEdgePiece>& pieces,
                   int axis,
                   int fold)
        : m_lattice(lattice), m_pieces(pieces), m_axis(axis), m_fold(fold) {
        fitLines();
    }

    /// Corners in the picture, and how many squares along the fold and away from it they lie, below
    /// 0 on the first board.
    struct TCorner {
        int along, away;
        TPoint2D pixel;
    };
    std::vector<TCorner> corners() const {
        std::vector<TCorner> all;
        for (const auto& [node, rough] : m_lattice.nodes()) {
            const TNode n = turned(node);
            const int side = n.second < m_fold ? 0 : 1;
            const auto row = m_rows.find(n.second);
            const auto column = m_columns[side].find(n.first);
            if (n.second == m_fold || row == m_rows.end() || column == m_columns[side].end())
                continue;
            const auto corner = intersection(row->second, column->second);
            if (corner && (*corner - rough).norm() < kFarthest)
                all.push_back({n.first, n.second - m_fold, *corner});
        }
        return all;
    }

 private:
    /// So that the fold is a row.
    TNode turned(const TNode& n) const { return m_axis == 0 ? n : TNode{n.second, n.first}; }

    void fitLines() {
        std::map<int, std::vector<TPoint2D>> rows, columns[2];
        const auto add = [&](std::vector<TPoint2D>& to, std::size_t piece) {
            const auto& points = m_pieces[piece].points;
            to.insert(to.end(), points.begin(), points.end());
        };
        for (const auto& [node, piece] : m_lattice.pieces(m_axis))
            add(rows[turned(node).second], piece);
        for (const auto& [node, piece] : m_lattice.pieces(1 - m_axis)) {
            const TNode n = turned(node);  // leads from row n.second to the next
            add(columns[n.second < m_fold ? 0 : 1][n.first], piece);
        }
        for (const auto& [row, points] : rows)
            if (const auto line = fitLine(points)) m_rows.emplace(row, *line);
        for (int side = 0; side < 2; ++side)
            for (const auto& [column, points] : columns[side])
                if (const auto line = fitLine(points)) m_columns[side].emplace(column, *line);
    }

    const CLattice& m_lattice;
    const std::vector<TEdgePiece>& m_pieces;
    int m_axis, m_fold;
    std::map<int, TImageLine> m_rows, m_columns[2];
};

/// World and picture, with x along the fold one way or the other.
std::vector<TSpacePoint> inSpace(const std::vector<CFoldedLattice::TCorner>& corners,
                                 double square,
                                 bool reversed) {
    double heights[2] = {0, 0}, counts[2] = {0, 0};
    int first = std::numeric_limits<int>::max(), last = std::numeric_limits<int>::min();
    for (const auto& c : corners) {
        heights[c.away < 0 ? 0 : 1] += c.pixel.y;
        counts[c.away < 0 ? 0 : 1] += 1;
        first = std::min(first, c.along);
        last = std::max(last, c.along);
    }
    if (counts[0] < 4 || counts[1] < 4) return {};
    const int upper = heights[0] / counts[0] < heights[1] / counts[1] ? 0 : 1;
    std::vector<TSpacePoint> points;
    for (const auto& c : corners) {
        const double x = square * (reversed ? last - c.along : c.along - first);
        const double away = square * std::abs(c.away);
        const bool isUpper = (c.away < 0 ? 0 : 1) == upper;
        points.push_back({TPoint3D(x, isUpper ? away : 0, isUpper ? 0 : away), c.pixel});
    }
    return points;
}

/// What no camera of our time has comes from points that are not what they are taken for.
bool plausible(const CCameraMatrix& camera, const cv::Size& size) {
    const auto& K = camera.K();
    const double aspect = K(0, 0) / K(1, 1);
    return aspect > 0.7 && aspect < 1.4 && std::abs(K(0, 1)) < 0.2 * K(0, 0) &&
           std::abs(K(0, 2) - size.width / 2.0) < size.width &&
           std::abs(K(1, 2) - size.height / 2.0) < size.height;
}

/// The best camera of all folds, and its points.
struct TBest {
    std::optional<CCameraMatrix> camera;
    std::vector<TSpacePoint> points;
    double rms{std::numeric_limits<double>::infinity()};
};

TBest bestFold(const CLattice& lattice,
               const std::vector<TEdgePiece>& pieces,
               const TTsaiOptions& options,
               double square,
               const cv::Size& size) {
    TBest best;
    for (const int axis : {0, 1}) {
        int low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();
        for (const auto& [node, rough] : lattice.nodes()) {
            low = std::min(low, axis == 0 ? node.second : node.first);
            high = std::max(high, axis == 0 ? node.second : node.first);
        }
        for (int fold = low + 2; fold + 2 <= high; ++fold) {
            const auto corners = CFoldedLattice(lattice, pieces, axis, fold).corners();
            for (const bool reversed : {false, true}) {
                auto points = inSpace(corners, square, reversed);
                if (points.size() < static_cast<std::size_t>(options.minPoints)) continue;
                const auto camera = CCameraMatrix::through(points);
                if (!camera || !plausible(*camera, size)) continue;
                const double rms = camera->rms(points);
                if (rms < best.rms) best = {camera, std::move(points), rms};
            }
        }
    }
    return best;
}

/// What is left if the two boards are taken for one plane, their lattice unfolded [px].
double rmsOfOnePlane(const std::vector<TSpacePoint>& points) {
    std::vector<TPoint2D> flat, seen;
    for (const auto& p : points) {
        flat.emplace_back(p.world.x, p.world.y - p.world.z);
        seen.push_back(p.pixel);
    }
    const auto H = CHomography::through(flat, seen);
    if (!H) return std::numeric_limits<double>::infinity();
    double squares = 0;
    for (std::size_t i = 0; i < flat.size(); ++i) squares += (H->map(flat[i]) - seen[i]).sqrNorm();
    return std::sqrt(squares / static_cast<double>(flat.size()));
}

double robustDeviation(const CCameraMatrix& camera, const std::vector<TSpacePoint>& points) {
    std::vector<double> misses;
    for (const auto& p : points) misses.push_back((camera.project(p.world) - p.pixel).norm());
    const auto middle = misses.begin() + static_cast<std::ptrdiff_t>(misses.size() / 2);
    std::nth_element(misses.begin(), middle, misses.end());
    return *middle / 1.1774;  // the median of a Rayleigh distribution
}

}  // namespace

void TTsaiOptions::visit(config::COptionVisitor& v) {
    v.integer("working_size_px", workingSize, config::between(100, 1e5),
              "larger pictures are made so large");
    v.number("smoothing_px", smoothing, config::moreThan(0), "before Canny's detector");
    v.number("low_contrast", lowContrast, config::moreThan(0),
             "Canny's lower threshold; the upper one is twice it");
    v.number("bend_px", bend, config::moreThan(0), "edges that bend more are cut there");
    v.number("min_length_px", minLength, config::atLeast(6), "shorter pieces are not used");
    v.integer("min_points", minPoints, config::between(28, 1e6), "fewer corners are no grid");
    v.number("outlier_sigma", outlier, config::atLeast(2),
             "corners that miss by more are left out");
}

CTsaiGrid::CTsaiGrid(const TTsaiOptions& options) : m_options(options) { m_options.validate(); }

TTsaiResult CTsaiGrid::calibrate(const cv::Mat& grey, double square) const {
    if (grey.type() != CV_8UC1)
        throw std::invalid_argument("a grid is looked for in a grey picture of 8 bits");
    if (!(square > 0) || !std::isfinite(square))
        throw std::invalid_argument("a grid needs squares larger than 0 m");
    const double scale =
        std::min(1.0, m_options.workingSize / static_cast<double>(std::max(grey.cols, grey.rows)));
    cv::Mat small, edges;
    if (scale < 1)
        cv::resize(grey, small, {}, scale, scale, cv::INTER_AREA);
    else
        small = grey;
    cv::GaussianBlur(small, small, {0, 0}, m_options.smoothing);
    cv::Canny(small, edges, m_options.lowContrast, 2 * m_options.lowContrast, 3, true);
    const auto pieces = straightPieces(linkEdges(edges), m_options.bend, m_options.minLength);
    const CLattice lattice(pieces);
    if (lattice.nodes().size() < static_cast<std::size_t>(m_options.minPoints))
        throw std::runtime_error("only " + std::to_string(lattice.nodes().size()) +
                                 " corners hang together in a grid; " +
                                 std::to_string(m_options.minPoints) + " are needed");
    TBest best = bestFold(lattice, pieces, m_options, square, small.size());
    if (!best.camera || !(rmsOfOnePlane(best.points) > kFolded * best.rms))
        throw std::runtime_error("the " + std::to_string(lattice.nodes().size()) +
                                 " corners of the grid are not of two boards at a right angle");
    for (auto& p : best.points)
        p.pixel = {(p.pixel.x + 0.5) / scale - 0.5, (p.pixel.y + 0.5) / scale - 0.5};
    const auto linear = CCameraMatrix::through(best.points);
    if (!linear) throw std::runtime_error("the corners of the grid determine no camera");
    TTsaiResult result{linear->refined(best.points), 0, {}, {}};
    const double limit = m_options.outlier * robustDeviation(result.camera, best.points);
    for (const auto& p : best.points)
        ((result.camera.project(p.world) - p.pixel).norm() <= limit ? result.points
                                                                    : result.outliers)
            .push_back(p);
    const auto start = CCameraMatrix::through(result.points);
    if (!start || result.points.size() < static_cast<std::size_t>(m_options.minPoints))
        throw std::runtime_error("too few corners of the grid agree on a camera");
    result.linearRms = start->rms(result.points);
    result.camera = start->refined(result.points);
    if (!plausible(result.camera, grey.size()))
        throw std::runtime_error("the corners of the grid determine no camera");
    return result;
}

}  // namespace salma::calibration
