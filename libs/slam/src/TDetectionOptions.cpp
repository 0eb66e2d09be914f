// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/TDetectionOptions.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace salma::slam {
namespace {

double interpolated(const std::vector<double>& knots, const std::vector<double>& values, double x) {
    if (!(x > knots.front())) return values.front();
    if (x >= knots.back()) return values.back();
    const auto upper = std::upper_bound(knots.begin(), knots.end(), x);
    const auto k = static_cast<std::size_t>(upper - knots.begin());
    const double share = (x - knots[k - 1]) / (knots[k] - knots[k - 1]);
    return values[k - 1] + share * (values[k] - values[k - 1]);
}

void checkTable(const std::string& key,
                const std::vector<double>& knots,
                const std::vector<double>& values) {
    if (knots.empty() || knots.size() != values.size())
        throw std::invalid_argument(key +
                                    " must have as many numbers as its knots, and one at "
                                    "least");
    const auto falling = [](double a, double b) { return !(a < b); };
    if (std::adjacent_find(knots.begin(), knots.end(), falling) != knots.end())
        throw std::invalid_argument("the knots of " + key + " must ascend");
}

}  // namespace

void TDetectionOptions::visit(config::COptionVisitor& v) {
    v.numbers("incidence_knots_deg", incidence, config::between(0, 90),
              "ascending angles between the ray to a poster and the wall's normal, each");
    v.numbers("by_incidence", byIncidence, config::between(0, 1),
              "probability at each that a poster in view is found");
    v.numbers("range_knots_m", range, config::atLeast(0), "ascending distances, each");
    v.numbers("by_range", byRange, config::between(0, 1), "factor at each");
    v.numbers("corner_range_knots_m", cornerRange, config::atLeast(0),
              "ascending distances of corners, each");
    v.numbers("by_corner_range", byCornerRange, config::between(0, 1),
              "probability at each that a corner in view is found");
}

void TDetectionOptions::validate() const {
    checkRanges();
    checkTable("by_incidence", incidence, byIncidence);
    checkTable("by_range", range, byRange);
    checkTable("by_corner_range", cornerRange, byCornerRange);
}

double TDetectionOptions::probability(double angle, double distance) const {
    return interpolated(incidence, byIncidence, std::abs(angle) * 180 / M_PI) *
           interpolated(range, byRange, distance);
}

double TDetectionOptions::cornerProbability(double distance) const {
    return interpolated(cornerRange, byCornerRange, distance);
}

}  // namespace salma::slam
