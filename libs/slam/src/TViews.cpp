// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/TViews.h>

#include <algorithm>
#include <cmath>

namespace salma::slam {
namespace {

/// Range and direction of a point from a scanner, counted in beams from the first.
struct TBeamPlace {
    double range{0};
    double beam{0};
};

TBeamPlace placeOf(const TLaserView& view, const Eigen::Vector2d& point) {
    const Eigen::Vector2d ray = point - view.sensor.head<2>();
    // Counted from the middle of the field, so that the wrap lies behind the scanner.
    const double bearing =
        mrpt::math::wrapToPi(std::atan2(ray.y(), ray.x()) - view.sensor[2] - view.middle());
    return {ray.norm(), bearing / view.spacing + 0.5 * (double(view.free->size()) - 1)};
}

}  // namespace

bool TLaserView::looksAt(const Eigen::Vector2d& point) const {
    if (!free || !(spacing > 0)) return false;
    const double beam = placeOf(*this, point).beam;
    return beam >= -0.5 && beam <= double(free->size()) - 0.5;
}

double TLaserView::reaching(const Eigen::Vector2d& point, double slack, double spread) const {
    if (!looksAt(point)) return 1;
    const TBeamPlace place = placeOf(*this, point);
    const double half = std::max(1.0, spread / std::max(place.range, 0.1) / spacing);
    const auto last = static_cast<double>(free->size() - 1);
    const auto from = static_cast<std::size_t>(std::clamp(std::ceil(place.beam - half), 0.0, last));
    const auto to = static_cast<std::size_t>(std::clamp(std::floor(place.beam + half), 0.0, last));
    std::size_t reached = 0;
    for (std::size_t k = from; k <= to; ++k) reached += (*free)[k] >= place.range - slack ? 1U : 0U;
    return double(reached) / double(to - from + 1);
}

}  // namespace salma::slam
