// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/CMapJoin.h>

#include <algorithm>

#include "planeMotion.h"

namespace salma::slam {

namespace {

/// Mean squared normalised residual up to which a landmark that was joined is believed.
constexpr double largestMisfit = 4;
constexpr double leastFitting = 0.75;  // share of an alignment's pairs

}  // namespace

std::size_t TJoinedMap::indexOf(int id) const {
    const auto kept = keptOf.find(id);
    return landmarks.indexOf(kept == keptOf.end() ? id : kept->second);
}

/* The estimation starts from a path that is bent so that the ends meet: where the left map ends
 * nothing moves, the local map moves as the alignment says, and in between the motion is shared
 * out. */
TJoinedMap CMapJoin::joined(const TAlignment& alignment, bool withCovariance) const {
    TJoinedMap result{m_history, m_landmarks, {}, {}};
    const auto steps = m_history.steps();
    std::size_t leftEnd = 0, localStart = m_history.size();
    for (const TSameLandmark& pair : alignment.pairs) {
        const int gone = m_landmarks[pair.local].id, kept = m_landmarks[pair.left].id;
        localStart = std::min(localStart, steps.at(gone).first);
        leftEnd = std::max(leftEnd, steps.at(kept).second);
        result.keptOf[gone] = kept;
    }
    const double from = m_history[leftEnd].travel, to = m_history[localStart].travel;
    const auto shareAt = [&](std::size_t k) {
        if (!(to > from)) return k >= localStart ? 1.0 : 0.0;
        return std::clamp((m_history[k].travel - from) / (to - from), 0.0, 1.0);
    };
    for (std::size_t k = 0; k < m_history.size(); ++k)
        result.history.setPose(k,
                               appliedToPose(shareOf(alignment.T, shareAt(k)), m_history[k].pose));
    for (const auto& [gone, kept] : result.keptOf) {
        result.history.rename(gone, kept);
        result.landmarks.merge(result.landmarks.indexOf(kept), result.landmarks.indexOf(gone));
    }
    std::vector<int> order;
    std::vector<Eigen::Vector2d> places;
    for (std::size_t i = 0; i < m_landmarks.size(); ++i) {
        const int id = m_landmarks[i].id;
        if (result.keptOf.count(id) != 0) continue;
        order.push_back(id);
        places.push_back(applied(shareOf(alignment.T, shareAt(steps.at(id).first)),
                                 m_mean.segment<2>(3 + 2 * static_cast<Eigen::Index>(i))));
    }
    result.smoothed = CPathSmoother().smooth(result.history, order, places, withCovariance);
    return result;
}

/* A pair that does not fit the rest is left out: a corner may stand beside another. More than a few
 * of them are an alignment that is wrong. */
std::optional<TJoinedMap> CMapJoin::fitting(TAlignment& alignment, bool withCovariance) const {
    auto& pairs = alignment.pairs;
    const std::size_t before = pairs.size();
    for (;;) {
        TJoinedMap all = joined(alignment, withCovariance);
        const auto misfits = [&](const TSameLandmark& pair) {
            return !(all.smoothed.misfit[all.indexOf(m_landmarks[pair.left].id)] <= largestMisfit);
        };
        const auto end = std::remove_if(pairs.begin(), pairs.end(), misfits);
        if (end == pairs.end()) return all;
        pairs.erase(end, pairs.end());
        if (static_cast<double>(pairs.size()) < leastFitting * static_cast<double>(before))
            return {};
    }
}

TLaidMaps CMapJoin::laid(const TJoinedMap& joined) const {
    const auto& [poses, mean, covariance, misfit, cost, iterations, converged] = joined.smoothed;
    TLaidMaps result{m_history, m_landmarks, m_mean};
    for (std::size_t k = 0; k < m_history.size(); ++k) result.history.setPose(k, poses[k]);
    result.mean.head<3>() = mean.head<3>();
    const auto steps = m_history.steps();
    for (std::size_t i = 0; i < m_landmarks.size(); ++i) {
        const int id = m_landmarks[i].id;
        result.mean.segment<2>(3 + 2 * static_cast<Eigen::Index>(i)) =
            mean.segment<2>(3 + 2 * static_cast<Eigen::Index>(joined.indexOf(id)));
        const std::size_t last = steps.at(id).second;
        result.landmarks.turn(i, poses[last][2] - m_history[last].pose[2]);
    }
    return result;
}

}  // namespace salma::slam
