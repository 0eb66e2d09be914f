// SPDX-License-Identifier: BSD-3-Clause
#include <salma/drivers/TZoomModel.h>

#include <algorithm>
#include <cmath>

namespace salma::drivers {
namespace {

/// Logarithm of the longest focal length over the shortest.
double span(const TZoomModel& model) {
    return std::log(std::tan(model.wideField / 2) / std::tan(model.teleField / 2));
}

}  // namespace

double TZoomModel::factor(int counts) const {
    const double part = std::clamp(counts, 0, maxCounts) / static_cast<double>(maxCounts);
    return std::exp(part * span(*this));
}

int TZoomModel::counts(double factor) const {
    const double part = std::clamp(std::log(factor) / span(*this), 0.0, 1.0);
    return static_cast<int>(std::lround(part * maxCounts));
}

double TZoomModel::field(double factor) const {
    return 2 * std::atan(std::tan(wideField / 2) / factor);
}

}  // namespace salma::drivers
