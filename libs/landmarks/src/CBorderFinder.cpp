// SPDX-License-Identifier: BSD-3-Clause
#include <salma/landmarks/CBorderFinder.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "CLineSupport.h"
#include "CStripHistograms.h"

namespace salma::landmarks {
namespace {

/// A side's continuation is judged over this length, and a side's outside over this width [m].
constexpr double kBeyond = 0.12, kOutsideFrom = 0.02, kOutsideTo = 0.05;

/// Strips inside and outside of a side are as wide as a course of bricks [m].
constexpr double kStrip = 0.08;

/// Mean grey level for which `contrast` is meant; in darker pictures edges are weaker, down to what
/// the camera's noise makes of a wall.
constexpr double kBrightness = 110, kLeastShare = 0.4;

/// A region may be centred on the frame [m].
constexpr double kRim = 0.04;

/// Where the sides across one axis may lie: from `first` (outermost) to `last` [px].
struct TSpan {
    double lowFirst, lowLast, highFirst, highLast;
};

/// A side lies outside all but 1 - `share` of the values (or by `rim` inside), at most `grow` away.
TSpan spanOf(std::vector<double> values, double share, double grow, double rim) {
    std::sort(values.begin(), values.end());
    const auto out = static_cast<std::size_t>((1 - share) * static_cast<double>(values.size()));
    return {values.front() - grow, values[out] + rim, values[values.size() - 1 - out] - rim,
            values.back() + grow};
}

cv::Range rangeIn(double from, double to, int size) {
    return {std::clamp(static_cast<int>(std::floor(from)), 0, size - 1),
            std::clamp(static_cast<int>(std::ceil(to)), 0, size - 1) + 1};
}

/// How much more of a side shows an edge than of its continuation beyond both corners, as a share
/// of what more there could be: lines that go on are no sides, whatever the texture of the wall.
double closedSupport(const CLineSupport& lines,
                     int line,
                     const cv::Range& side,
                     double pixelsPerMetre) {
    const int skip = std::max(2, static_cast<int>(kOutsideFrom * pixelsPerMetre));
    const int length = std::max(4, static_cast<int>(kBeyond * pixelsPerMetre));
    const double before = lines.share(line, {side.start - skip - length, side.start - skip});
    const double after = lines.share(line, {side.end + skip, side.end + skip + length});
    const double beside = (before + after) / 2;
    if (!(beside < 1)) return 0;
    return (lines.share(line, side) - beside) / (1 - beside);
}

struct TCandidate {
    cv::Rect rectangle;
    double quality;  //!< Support of its weakest side times the separation of inside and outside.
};

/// The largest of the rectangles that are good enough.
std::optional<cv::Rect2d> largestOf(const std::vector<TCandidate>& candidates, double enough) {
    const TCandidate* winner = nullptr;
    for (const auto& c : candidates)
        if (c.quality >= enough && (!winner || c.rectangle.area() > winner->rectangle.area()))
            winner = &c;
    if (!winner) return std::nullopt;
    return cv::Rect2d(winner->rectangle);
}

/// Mean and standard deviation of the wall in a strip; nothing if less than half of it is known.
std::optional<std::pair<double, double>> brightness(const cv::Mat& wall,
                                                    const cv::Mat& valid,
                                                    const cv::Rect& strip) {
    const cv::Rect known = strip & cv::Rect({0, 0}, wall.size());
    if (known.area() * 2 < strip.area() || known.area() == 0) return std::nullopt;
    if (cv::countNonZero(valid(known)) * 2 < strip.area()) return std::nullopt;
    cv::Scalar mean, deviation;
    cv::meanStdDev(wall(known), mean, deviation, valid(known));
    return std::make_pair(mean[0], deviation[0]);
}

/// True if the same surface lies outside all four sides.
bool onOneWall(const cv::Mat& wall,
               const cv::Mat& valid,
               const cv::Rect& r,
               const cv::Point2d& pixelsPerMetre,
               double tolerance) {
    const auto px = [](double metres, double resolution) {
        return std::max(2, static_cast<int>(std::lround(metres * resolution)));
    };
    const int x0 = px(kOutsideFrom, pixelsPerMetre.x), y0 = px(kOutsideFrom, pixelsPerMetre.y);
    const int dx = px(kOutsideTo - kOutsideFrom, pixelsPerMetre.x);
    const int dy = px(kOutsideTo - kOutsideFrom, pixelsPerMetre.y);
    const cv::Rect strips[] = {{r.x - x0 - dx, r.y, dx, r.height},
                               {r.br().x + x0, r.y, dx, r.height},
                               {r.x, r.y - y0 - dy, r.width, dy},
                               {r.x, r.br().y + y0, r.width, dy}};
    double low = 1e9, high = -1e9, calm = 1e9, busy = 0;
    for (const auto& strip : strips) {
        const auto seen = brightness(wall, valid, strip);
        if (!seen) return false;
        low = std::min(low, seen->first);
        high = std::max(high, seen->first);
        calm = std::min(calm, seen->second);
        busy = std::max(busy, seen->second);
    }
    return high - low <= tolerance + calm && busy - calm <= tolerance / 2 + calm;
}

/// True if `share` of the regions lies in the rectangle.
bool holds(const cv::Rect2d& r,
           const std::vector<cv::Point2d>& regions,
           const cv::Point2d& pixelsPerMetre,
           double share) {
    const cv::Point2d rim = kRim * pixelsPerMetre;
    const cv::Rect2d wide(r.tl() - rim, r.br() + rim);
    const auto n = std::count_if(regions.begin(), regions.end(),
                                 [&](const cv::Point2d& p) { return wide.contains(p); });
    return static_cast<double>(n) >= share * static_cast<double>(regions.size());
}

}  // namespace

void TBorderOptions::visit(config::COptionVisitor& v) {
    v.number("grow_m", grow, config::between(0, 3), "how far a side may lie outside the regions");
    v.number("contrast", contrast, config::moreThan(0),
             "grey levels per pixel by which an edge changes");
    v.number("support", support, config::between(0.1, 1),
             "share of a side that is an edge, less that of its continuation, at least");
    v.number("near_best", nearBest, config::between(0, 1),
             "the largest rectangle wins whose support times separation is this share of the best");
    v.number("inside", inside, config::between(0.5, 1), "share of the regions inside, at least");
    v.number("same_wall", sameWall, config::atLeast(0),
             "grey levels by which the wall may differ outside of the four sides");
    v.number("difference", difference, {0, 1, true},
             "Hellinger distance of the grey levels in- and outside of a side that says nothing");
    v.number("separation", separation, config::between(0, 1),
             "share of the border that must tell inside from outside, at least");
    v.number("side_sigma_m", sideSigma, config::atLeast(0),
             "error of a side's place, which the covariance of the patch's centre holds");
}

CBorderFinder::CBorderFinder(const TBorderOptions& options) : m_options(options) {
    m_options.validate();
}

std::optional<cv::Rect2d> CBorderFinder::find(const cv::Mat& wall,
                                              const cv::Mat& valid,
                                              const std::vector<cv::Point2d>& regions,
                                              const cv::Point2d& pixelsPerMetre) const {
    if (wall.rows < 8 || wall.cols < 8 || regions.empty()) return std::nullopt;
    const double brightness = cv::mean(wall, valid)[0] / kBrightness;
    const double contrast = m_options.contrast * std::clamp(brightness, kLeastShare, 1.0);
    const CLineSupport upright(wall, valid, contrast);
    const CLineSupport level(wall.t(), valid.t(), contrast);
    const CStripHistograms strips(wall, valid);
    const cv::Size strip(std::max(1, static_cast<int>(kStrip * pixelsPerMetre.x)),
                         std::max(1, static_cast<int>(kStrip * pixelsPerMetre.y)));
    std::vector<double> xs, ys;
    for (const auto& p : regions) {
        xs.push_back(p.x);
        ys.push_back(p.y);
    }
    const TSpan x =
        spanOf(xs, m_options.inside, m_options.grow * pixelsPerMetre.x, kRim * pixelsPerMetre.x);
    const TSpan y =
        spanOf(ys, m_options.inside, m_options.grow * pixelsPerMetre.y, kRim * pixelsPerMetre.y);
    // Whatever the rectangle, its sides cross these rows and columns.
    const cv::Range rows =
        rangeIn(std::min(y.lowLast, y.highFirst), std::max(y.lowLast, y.highFirst), wall.rows);
    const cv::Range columns =
        rangeIn(std::min(x.lowLast, x.highFirst), std::max(x.lowLast, x.highFirst), wall.cols);
    const auto lefts = upright.lines(rangeIn(x.lowFirst, x.lowLast, wall.cols), rows);
    const auto rights = upright.lines(rangeIn(x.highFirst, x.highLast, wall.cols), rows);
    const auto tops = level.lines(rangeIn(y.lowFirst, y.lowLast, wall.rows), columns);
    const auto bottoms = level.lines(rangeIn(y.highFirst, y.highLast, wall.rows), columns);

    std::vector<TCandidate> candidates;
    double best = 0;
    const auto consider = [&](int left, int right, int top, int bottom) {
        const cv::Range side(top + 1, bottom), edge(left + 1, right);
        double support = 1;
        const auto judge = [&](const CLineSupport& lines, int line, const cv::Range& over,
                               double resolution) {
            if (support >= m_options.support)
                support = std::min(support, closedSupport(lines, line, over, resolution));
        };
        judge(upright, left, side, pixelsPerMetre.y);
        judge(upright, right, side, pixelsPerMetre.y);
        judge(level, top, edge, pixelsPerMetre.x);
        judge(level, bottom, edge, pixelsPerMetre.x);
        if (!(support >= m_options.support)) return;
        const cv::Rect r(left, top, right - left, bottom - top);
        if (!holds(r, regions, pixelsPerMetre, m_options.inside) ||
            !onOneWall(wall, valid, r, pixelsPerMetre, m_options.sameWall))
            return;
        const double separation = strips.separation(r, strip, m_options.difference);
        if (!(separation >= m_options.separation)) return;
        candidates.push_back({r, support * separation});
        best = std::max(best, support * separation);
    };
    for (const int left : lefts)
        for (const int right : rights)
            for (const int top : tops)
                for (const int bottom : bottoms)
                    if (right - left >= 6 && bottom - top >= 6) consider(left, right, top, bottom);
    return largestOf(candidates, m_options.nearBest * best);
}

}  // namespace salma::landmarks
