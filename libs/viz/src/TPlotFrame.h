// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "CTextFile.h"

namespace salma::viz {

inline std::string asText(const mrpt::math::TPoint2D& point) {
    return number(point.x) + " " + number(point.y);
}

/// The part of the plane that a map shows [m].
struct TPlotFrame {
    mrpt::math::TPoint2D min{std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::infinity()};
    mrpt::math::TPoint2D max{-std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()};

    double width() const { return max.x - min.x; }
    double height() const { return max.y - min.y; }

    void include(const mrpt::math::TPoint2D& point) {
        min = {std::min(min.x, point.x), std::min(min.y, point.y)};
        max = {std::max(max.x, point.x), std::max(max.y, point.y)};
    }

    /// All but the outer 4 % on each side: beams through doors and windows shall not shrink the
    /// rest.
    void includeMost(const std::vector<mrpt::math::TPoint2D>& points) {
        if (points.empty()) return;
        std::vector<double> x, y;
        for (const auto& point : points) {
            x.push_back(point.x);
            y.push_back(point.y);
        }
        include({quantile(x, 0.04), quantile(y, 0.04)});
        include({quantile(x, 0.96), quantile(y, 0.96)});
    }

    /// Adds a margin of 4 %, at least half a metre, and widens to `aspect` = width / height.
    void fit(double aspect) {
        if (!(min.x <= max.x)) min = max = {0, 0};  // nothing to show
        const double margin = std::max(0.5, 0.04 * std::max(width(), height()));
        min = {min.x - margin, min.y - margin};
        max = {max.x + margin, max.y + margin};
        const double addX = std::max(0.0, aspect * height() - width()) / 2;
        const double addY = std::max(0.0, width() / aspect - height()) / 2;
        min = {min.x - addX, min.y - addY};
        max = {max.x + addX, max.y + addY};
    }

 private:
    static double quantile(std::vector<double>& values, double q) {
        const auto index = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
        std::nth_element(values.begin(), values.begin() + index, values.end());
        return values[static_cast<std::size_t>(index)];
    }
};

}  // namespace salma::viz
