// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/CRelocator.h>

#include <algorithm>
#include <cmath>

#include "CLocalMapSearch.h"

namespace salma::slam {

double TAlignment::score(double geometryCap) const {
    return posters + std::min(signs + corners, geometryCap) + std::min(odometry, 0.0);
}

std::size_t TAlignment::matchedPosters() const {
    return static_cast<std::size_t>(std::count_if(
        pairs.begin(), pairs.end(), [](const auto& p) { return !std::isnan(p.logRatio); }));
}

CRelocator::CRelocator(const TRelocationOptions& options, const TDetectionOptions& detection)
    : m_options(options), m_detection(detection) {
    m_options.validate();
}

TRelocation CRelocator::find(const TRelocationInput& input) {
    return CLocalMapSearch(m_options, m_detection, input, m_ratios).run();
}

}  // namespace salma::slam
