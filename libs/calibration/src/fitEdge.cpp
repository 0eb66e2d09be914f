// SPDX-License-Identifier: BSD-3-Clause
#include "fitEdge.h"

#include <algorithm>
#include <cmath>

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;

constexpr double kLeastContrast = 12;  ///< Grey levels that a profile must rise or fall.
constexpr double kStep = 0.5;          ///< [px] Between samples of a profile.

double greyAt(const cv::Mat& grey, double u, double v) {
    const int x = std::clamp(static_cast<int>(std::floor(u)), 0, grey.cols - 2);
    const int y = std::clamp(static_cast<int>(std::floor(v)), 0, grey.rows - 2);
    const double a = std::clamp(u - x, 0.0, 1.0), b = std::clamp(v - y, 0.0, 1.0);
    const auto at = [&](int r, int c) { return static_cast<double>(grey.at<unsigned char>(r, c)); };
    return (1 - b) * ((1 - a) * at(y, x) + a * at(y, x + 1)) +
           b * ((1 - a) * at(y + 1, x) + a * at(y + 1, x + 1));
}

/// Where along the profile the grey level changes [px from its middle], with the sign of the
/// change.
struct TCrossing {
    double place{0};
    double rise{0};
};

TCrossing crossing(const cv::Mat& grey,
                   const TPoint2D& middle,
                   const TPoint2D& across,
                   double reach) {
    const int n = static_cast<int>(2 * reach / kStep);
    std::vector<double> change;
    double before = greyAt(grey, middle.x - reach * across.x, middle.y - reach * across.y);
    for (int i = 1; i <= n; ++i) {
        const double at = -reach + i * kStep;
        const double now = greyAt(grey, middle.x + at * across.x, middle.y + at * across.y);
        change.push_back(now - before);
        before = now;
    }
    double total = 0, moment = 0;
    for (const double c : change) total += c;
    for (std::size_t i = 0; i < change.size(); ++i) {
        // A change the other way is noise or another edge.
        const double weight = std::max(0.0, total > 0 ? change[i] : -change[i]);
        moment += weight * (-reach + (static_cast<double>(i) + 0.5) * kStep);
    }
    double weights = 0;
    for (const double c : change) weights += std::max(0.0, total > 0 ? c : -c);
    return {weights > 0 ? moment / weights : 0, total};
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::optional<TImageLine> leastSquares(const std::vector<TPoint2D>& points) {
    if (points.size() < 4) return std::nullopt;
    const auto n = static_cast<double>(points.size());
    TPoint2D mean(0, 0);
    for (const auto& p : points) mean = mean + p * (1 / n);
    double xx = 0, xy = 0, yy = 0;
    for (const auto& p : points) {
        const TPoint2D d = p - mean;
        xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y;
    }
    if (!(xx + yy > 1e-9)) return std::nullopt;
    const double along = 0.5 * std::atan2(2 * xy, xx - yy);
    const TPoint2D normal(-std::sin(along), std::cos(along));
    return TImageLine{normal, normal.x * mean.x + normal.y * mean.y};
}

}  // namespace

std::optional<TPoint2D> intersection(const TImageLine& a, const TImageLine& b) {
    const double cross = a.normal.x * b.normal.y - a.normal.y * b.normal.x;
    if (!(std::abs(cross) > 0.087)) return std::nullopt;
    return TPoint2D((a.distance * b.normal.y - b.distance * a.normal.y) / cross,
                    (b.distance * a.normal.x - a.distance * b.normal.x) / cross);
}

std::optional<TImageLine> fitLine(const std::vector<TPoint2D>& points) {
    auto line = leastSquares(points);
    for (int round = 0; line && round < 2; ++round) {
        std::vector<double> misses;
        for (const auto& p : points) misses.push_back(std::abs(line->offset(p)));
        const double limit = std::max(0.1, 3 * 1.4826 * medianOf(misses));
        std::vector<TPoint2D> near;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (misses[i] <= limit) near.push_back(points[i]);
        line = leastSquares(near);
    }
    return line;
}

std::optional<TImageLine> fitEdge(const cv::Mat& grey, const TPoint2D& from, const TPoint2D& to) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length >= 4)) return std::nullopt;
    const TPoint2D along = (to - from) * (1 / length), across(-along.y, along.x);
    const double reach = std::clamp(0.2 * length, 1.5, 5.0);
    const int profiles = std::max(6, static_cast<int>(length));
    std::vector<TPoint2D> rising, falling;
    for (int i = 0; i < profiles; ++i) {
        const double place = length * (0.15 + 0.7 * i / (profiles - 1));
        const TPoint2D middle = from + along * place;
        const TCrossing found = crossing(grey, middle, across, reach);
        if (std::abs(found.rise) < kLeastContrast) continue;
        (found.rise > 0 ? rising : falling).push_back(middle + across * found.place);
    }
    const auto& points = rising.size() > falling.size() ? rising : falling;
    if (2 * points.size() < static_cast<std::size_t>(profiles)) return std::nullopt;
    return fitLine(points);
}

}  // namespace salma::calibration
