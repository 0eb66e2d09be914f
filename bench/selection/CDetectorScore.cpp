// SPDX-License-Identifier: BSD-3-Clause
#include "CDetectorScore.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace salma::bench {
namespace {

using Corners = Eigen::Matrix<double, 2, 4>;

constexpr double kNear = 0.05;  // [m]
constexpr int kDraws = 1000;

Corners cornersOf(const Eigen::Vector2d& half) {
    Corners c;
    c << -half.x(), half.x(), half.x(), -half.x(), half.y(), half.y(), -half.y(), -half.y();
    return c;
}

bool isNear(const Corners& a, const Corners& b) { return (a - b).cwiseAbs().maxCoeff() <= kNear; }

double median(std::vector<double> values) {
    if (values.empty()) return std::nan("");
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

/// Median over the selected views of a poster, each coordinate for itself.
std::vector<Corners> medians(const std::vector<TSeenView>& views, std::size_t posters) {
    std::vector<Corners> result(posters, Corners::Zero());
    for (std::size_t p = 0; p < posters; ++p)
        for (Eigen::Index i = 0; i < 8; ++i) {
            std::vector<double> values;
            for (const auto& v : views)
                if (v.poster == p && v.corners) values.push_back((*v.corners)(i % 2, i / 2));
            result[p](i % 2, i / 2) = median(values);
        }
    return result;
}

TShare shareOf(const std::vector<TSeenView>& views,
               std::size_t posters,
               const std::function<bool(const TSeenView&)>& counts,
               const std::function<bool(const TSeenView&)>& hits) {
    std::vector<std::size_t> of(posters), hit(posters);
    TShare share;
    for (const auto& v : views) {
        if (!counts(v)) continue;
        ++of[v.poster];
        ++share.of;
        if (!hits(v)) continue;
        ++hit[v.poster];
        ++share.hits;
    }
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> draw(0, posters - 1);
    std::vector<double> values;
    for (int i = 0; i < kDraws; ++i) {
        double n = 0, k = 0;
        for (std::size_t j = 0; j < posters; ++j) {
            const std::size_t p = draw(random);
            n += static_cast<double>(of[p]);
            k += static_cast<double>(hit[p]);
        }
        if (n > 0) values.push_back(k / n);
    }
    if (values.empty()) return share;
    std::sort(values.begin(), values.end());
    share.low = values[values.size() * 25 / 1000];
    share.high = values[std::min(values.size() - 1, values.size() * 975 / 1000)];
    return share;
}

void addNees(const std::vector<TSeenView>& views, TDetectorFigures& f) {
    for (const auto& v : views) {
        if (!v.corners) continue;
        const double all = v.error.dot(v.covariance.ldlt().solve(v.error));
        const int pick[] = {0, 1, 3};
        Eigen::Vector3d e;
        Eigen::Matrix3d P;
        for (int i = 0; i < 3; ++i) {
            e[i] = v.error[pick[i]];
            for (int j = 0; j < 3; ++j) P(i, j) = v.covariance(pick[i], pick[j]);
        }
        const double plane = e.dot(P.ldlt().solve(e));
        ++f.count;
        f.nees6 += all;
        f.nees3 += plane;
        if (!isNear(*v.corners, cornersOf(v.half))) continue;
        ++f.countNear;
        f.nees3Near += plane;
    }
    f.nees6 /= static_cast<double>(f.count);
    f.nees3 /= static_cast<double>(f.count);
    f.nees3Near /= static_cast<double>(f.countNear);
}

}  // namespace

TDetectorFigures figuresOf(const std::vector<TSeenView>& views, std::size_t posters) {
    const auto middle = medians(views, posters);
    const auto all = [](const TSeenView&) { return true; };
    const auto selected = [](const TSeenView& v) { return v.corners.has_value(); };
    const auto nearTruth = [](const TSeenView& v) {
        return v.corners && isNear(*v.corners, cornersOf(v.half));
    };
    TDetectorFigures f;
    f.selected = shareOf(views, posters, all, selected);
    f.nearTruth = shareOf(views, posters, selected, nearTruth);
    f.nearMedian = shareOf(views, posters, selected, [&](const TSeenView& v) {
        return isNear(*v.corners, middle[v.poster]);
    });
    f.wholly = shareOf(views, posters, all, nearTruth);
    std::vector<double> sides;
    for (const auto& v : views) {
        f.falsePerView += static_cast<double>(v.falseEntities) / static_cast<double>(views.size());
        f.milliseconds += 1e3 * v.seconds / static_cast<double>(views.size());
        if (!v.corners) continue;
        const Corners error = (*v.corners - cornersOf(v.half)).cwiseAbs();
        sides.insert(sides.end(), error.data(), error.data() + error.size());
    }
    f.medianSideError = median(sides);
    addNees(views, f);
    return f;
}

}  // namespace salma::bench
