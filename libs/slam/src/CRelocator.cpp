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
    const double since = input.history.back().travel - m_options.localTravel;
    TRelocation result = CLocalMapSearch(m_options, m_detection, input, since, m_ratios).run();
    if (result.best.pairs.empty()) return result;
    if (!(result.best.score(m_options.geometryCap) >= m_options.propose))
        result.outcome = ERelocation::unproved;
    else if (!(result.margin >= m_options.margin))
        result.outcome = ERelocation::ambiguous;
    else
        result.outcome = ERelocation::found;
    return result;
}

TAlignment CRelocator::extended(const TRelocationInput& laid, const TAlignment& alignment) {
    const auto steps = laid.history.steps();
    double leftEnd = 0;
    for (const TSameLandmark& pair : alignment.pairs)
        leftEnd =
            std::max(leftEnd, laid.history[steps.at(laid.landmarks[pair.left].id).second].travel);
    return CLocalMapSearch(m_options, m_detection, laid, leftEnd + m_options.gap, m_ratios)
        .asTheyLie(alignment);
}

bool CRelocator::proves(const TAlignment& alignment) const {
    return alignment.score(m_options.geometryCap) >= m_options.accept;
}

}  // namespace salma::slam
