// SPDX-License-Identifier: BSD-3-Clause
#include <salma/landmarks/CBorderFinder.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace salma::landmarks {
namespace {

/// Contrast across vertical lines: change per pixel along x; negative where not known.
cv::Mat contrastAcross(const cv::Mat& wall, const cv::Mat& valid) {
    cv::Mat smooth, change, unknown;
    cv::GaussianBlur(wall, smooth, {3, 3}, 0.8);
    cv::Sobel(smooth, change, CV_32F, 1, 0, 3, 1.0 / 8);
    change = cv::abs(change);
    cv::erode(valid, unknown, cv::Mat::ones(3, 3, CV_8U));
    change.setTo(-1, unknown == 0);
    return change;
}

/// One line across the search direction: the contrast that all but `quantile` of its pixels reach.
double lineContrast(const cv::Mat& change, int column, cv::Range rows, double quantile) {
    std::vector<float> values;
    for (int y = rows.start; y < rows.end; ++y) {
        // the edge may wander by a pixel: camera and laser are not perfectly joined
        float best = change.at<float>(y, column);
        if (best < 0) continue;
        for (const int x : {column - 1, column + 1})
            if (x >= 0 && x < change.cols) best = std::max(best, change.at<float>(y, x));
        values.push_back(best);
    }
    if (static_cast<int>(values.size()) * 10 < rows.size() * 9 || values.empty()) return 0;
    const auto nth = values.begin() + static_cast<long>(quantile * (values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

struct TSearch {
    int inside;   //!< Column to begin with.
    int outside;  //!< Last column.
};

/// The first line from inside to outside that stands out.
std::optional<int> findSide(const cv::Mat& change,
                            cv::Range rows,
                            TSearch search,
                            const TBorderOptions& options) {
    const int step = search.outside < search.inside ? -1 : 1;
    std::vector<double> contrast;
    for (int x = search.inside; x != search.outside + step; x += step)
        contrast.push_back(lineContrast(change, x, rows, options.quantile));
    const double best = *std::max_element(contrast.begin(), contrast.end());
    if (!(best >= options.contrast)) return std::nullopt;
    const double enough = std::max(options.contrast, options.dominance * best);
    std::size_t i = 0;
    while (contrast[i] < enough) ++i;
    while (i + 1 < contrast.size() && contrast[i + 1] > contrast[i]) ++i;  // up to the crest
    std::size_t last = i;
    while (last + 1 < contrast.size() && contrast[last + 1] == contrast[i]) ++last;
    return search.inside + step * static_cast<int>((i + last) / 2);
}

/// False if lines between both sides are much like them: then they are texture, not a border.
bool standsOut(const cv::Mat& change,
               cv::Range rows,
               const std::array<int, 2>& sides,
               const TBorderOptions& options) {
    std::vector<double> inside;
    const int step = std::max(1, (sides[1] - sides[0]) / 40);
    for (int x = sides[0] + 4; x <= sides[1] - 4; x += step)
        inside.push_back(lineContrast(change, x, rows, options.quantile));
    if (inside.empty()) return false;
    const auto middle = inside.begin() + static_cast<long>(inside.size() / 2);
    std::nth_element(inside.begin(), middle, inside.end());
    const double side = std::min(lineContrast(change, sides[0], rows, options.quantile),
                                 lineContrast(change, sides[1], rows, options.quantile));
    return side >= options.prominence * *middle;
}

int clampTo(double value, int size) {
    return std::clamp(static_cast<int>(std::lround(value)), 0, size - 1);
}

/// Both sides across x, given the rows that the rectangle covers.
std::optional<std::array<int, 2>> findPair(const cv::Mat& change,
                                           cv::Range rows,
                                           std::array<double, 2> start,
                                           const std::array<double, 2>& reach,
                                           const TBorderOptions& options) {
    const double middle = (start[0] + start[1]) / 2;
    const auto left = findSide(change, rows,
                               {clampTo(std::min(start[0] + reach[1], middle), change.cols),
                                clampTo(start[0] - reach[0], change.cols)},
                               options);
    const auto right = findSide(change, rows,
                                {clampTo(std::max(start[1] - reach[1], middle), change.cols),
                                 clampTo(start[1] + reach[0], change.cols)},
                                options);
    if (!left || !right || !(*right - *left >= 4)) return std::nullopt;
    const std::array<int, 2> sides{*left, *right};
    if (!standsOut(change, rows, sides, options)) return std::nullopt;
    return sides;
}

}  // namespace

void TBorderOptions::visit(config::COptionVisitor& v) {
    v.number("grow_m", grow, config::between(0, 3),
             "how far a side may lie outside the regions' box");
    v.number("shrink_m", shrink, config::between(0, 1), "how far a side may lie inside it");
    v.number("quantile", quantile, config::between(0, 0.9),
             "share of a side that may lack contrast");
    v.number("contrast", contrast, config::moreThan(0),
             "grey levels per pixel that the rest of the side must change by");
    v.number("dominance", dominance, config::between(0, 1),
             "the nearest edge counts if it has this share of the best contrast");
    v.number("prominence", prominence, config::atLeast(0),
             "a side's contrast over that of lines between two sides");
}

CBorderFinder::CBorderFinder(const TBorderOptions& options) : m_options(options) {}

std::optional<cv::Rect2d> CBorderFinder::find(const cv::Mat& wall,
                                              const cv::Mat& valid,
                                              const cv::Rect2d& start,
                                              double pixelsPerMetre) const {
    if (wall.rows < 8 || wall.cols < 8) return std::nullopt;
    const cv::Mat acrossX = contrastAcross(wall, valid);
    const cv::Mat acrossY = contrastAcross(wall.t(), valid.t());
    const std::array<double, 2> reach{m_options.grow * pixelsPerMetre,
                                      m_options.shrink * pixelsPerMetre};
    std::array<double, 2> x{start.x, start.x + start.width};
    std::array<double, 2> y{start.y, start.y + start.height};
    // The rows and columns over which a side is judged depend on the other sides: the second and
    // third rounds judge each over the extent that the round before has found.
    for (int round = 0; round < 3; ++round) {
        const cv::Range rows(clampTo(y[0] + 2, wall.rows), clampTo(y[1] - 2, wall.rows) + 1);
        const cv::Range columns(clampTo(x[0] + 2, wall.cols), clampTo(x[1] - 2, wall.cols) + 1);
        if (rows.size() < 4 || columns.size() < 4) return std::nullopt;
        const std::array<double, 2> slack{std::max(3.0, 0.03 * pixelsPerMetre),
                                          std::max(3.0, 0.03 * pixelsPerMetre)};
        const auto& range = round == 0 ? reach : slack;
        const auto newX = findPair(acrossX, rows, x, range, m_options);
        const auto newY = findPair(acrossY, columns, y, range, m_options);
        if (!newX || !newY) return std::nullopt;
        x = {static_cast<double>((*newX)[0]), static_cast<double>((*newX)[1])};
        y = {static_cast<double>((*newY)[0]), static_cast<double>((*newY)[1])};
    }
    return cv::Rect2d(x[0], y[0], x[1] - x[0], y[1] - y[0]);
}

}  // namespace salma::landmarks
