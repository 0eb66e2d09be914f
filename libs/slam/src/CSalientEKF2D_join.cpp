// SPDX-License-Identifier: BSD-3-Clause
// Two maps that are one: laid together, judged by all that was seen, and joined.
#include <salma/slam/CPathSmoother.h>
#include <salma/slam/CSalientEKF2D.h>

#include <algorithm>

#include "planeMotion.h"

namespace salma::slam {

namespace {

/// Mean squared normalised residual up to which a landmark that was joined is believed.
constexpr double largestMisfit = 4;
constexpr double leastFitting = 0.75;  // share of an alignment's pairs
constexpr int extensions = 3;          // of the local map; more add nothing

}  // namespace

/* The path is bent so that the ends meet, for the estimation to start from: where the left map ends
 * nothing moves, the local map moves as the alignment says, and in between the motion is shared
 * out. */
CSalientEKF2D::TJoined CSalientEKF2D::bent(const TAlignment& alignment) const {
    TJoined result{m_history, m_landmarks, {}, {}, {}};
    std::size_t leftEnd = 0, localStart = m_history.size();
    for (const TSameLandmark& pair : alignment.pairs) {
        const int gone = m_landmarks[pair.local].id, kept = m_landmarks[pair.left].id;
        localStart = std::min(localStart, m_history.stepsOf(gone)->first);
        leftEnd = std::max(leftEnd, m_history.stepsOf(kept)->second);
        result.ids.emplace_back(gone, kept);
    }
    const double from = m_history[leftEnd].travel, to = m_history[localStart].travel;
    std::vector<double> shares;
    for (std::size_t k = 0; k < m_history.size(); ++k)
        shares.push_back(to > from
                             ? std::clamp((m_history[k].travel - from) / (to - from), 0.0, 1.0)
                             : (k >= localStart ? 1.0 : 0.0));
    for (std::size_t i = 0; i < m_landmarks.size(); ++i)
        result.places.push_back(
            applied(shareOf(alignment.T, shares[m_history.stepsOf(m_landmarks[i].id)->first]),
                    {m_xkk[3 + 2 * i], m_xkk[4 + 2 * i]}));
    for (std::size_t k = 0; k < m_history.size(); ++k)
        result.history.setPose(k,
                               appliedToPose(shareOf(alignment.T, shares[k]), m_history[k].pose));
    return result;
}

/// Both maps' landmarks become one, and path and map are estimated anew from all that was measured.
CSalientEKF2D::TJoined CSalientEKF2D::joined(const TAlignment& alignment,
                                             bool withCovariance) const {
    TJoined result = bent(alignment);
    for (const auto& [gone, kept] : result.ids) {
        const std::size_t index = result.landmarks.indexOf(gone);
        result.history.rename(gone, kept);
        result.places.erase(result.places.begin() + static_cast<std::ptrdiff_t>(index));
        result.landmarks.merge(result.landmarks.indexOf(kept), index);
    }
    std::vector<int> order;
    for (std::size_t i = 0; i < result.landmarks.size(); ++i)
        order.push_back(result.landmarks[i].id);
    result.smoothed = CPathSmoother().smooth(result.history, order, result.places, withCovariance);
    return result;
}

/* A pair that does not fit the rest is left out: a corner may stand beside another. More than a few
 * of them are an alignment that is wrong. */
std::optional<CSalientEKF2D::TJoined> CSalientEKF2D::fitting(TAlignment& alignment,
                                                             bool withCovariance) const {
    auto& pairs = alignment.pairs;
    const std::size_t before = pairs.size();
    for (;;) {
        TJoined all = joined(alignment, withCovariance);
        const auto misfits = [&](const TSameLandmark& pair) {
            const std::size_t kept = all.landmarks.indexOf(m_landmarks[pair.left].id);
            return !(all.smoothed.misfit[kept] <= largestMisfit);
        };
        const auto end = std::remove_if(pairs.begin(), pairs.end(), misfits);
        if (end == pairs.end()) return all;
        pairs.erase(end, pairs.end());
        if (static_cast<double>(pairs.size()) < leastFitting * static_cast<double>(before))
            return {};
    }
}

/// The landmarks as they lie once they are joined, each under its own id.
CSalientEKF2D::TLaid CSalientEKF2D::laid(const TJoined& all) const {
    TLaid result{m_history, m_landmarks, Eigen::VectorXd(m_xkk.size())};
    for (std::size_t k = 0; k < m_history.size(); ++k)
        result.history.setPose(k, all.smoothed.poses[k]);
    std::map<int, int> keptOf;
    for (const auto& [gone, kept] : all.ids) keptOf[gone] = kept;
    for (std::size_t i = 0; i < m_landmarks.size(); ++i) {
        const int id = m_landmarks[i].id;
        const auto merged = keptOf.find(id);
        const std::size_t index =
            all.landmarks.indexOf(merged == keptOf.end() ? id : merged->second);
        result.mean.segment<2>(3 + 2 * static_cast<Eigen::Index>(i)) =
            all.smoothed.mean.segment<2>(3 + 2 * static_cast<Eigen::Index>(index));
        const std::size_t last = m_history.stepsOf(id)->second;
        result.landmarks.turn(i, all.smoothed.poses[last][2] - m_history[last].pose[2]);
    }
    result.mean.head<3>() = all.smoothed.mean.head<3>();
    return result;
}

/* The local map is short, so that it is stiff. Once it is laid onto the other, what was seen before
 * it falls into place as well, and may speak for the alignment or against it. False if the path
 * does not allow the alignment. */
bool CSalientEKF2D::extend(TAlignment& alignment) {
    const RowMatrix covariance = state().covariance;
    for (int round = 0; round < extensions; ++round) {
        const auto all = fitting(alignment, false);
        if (!all) return false;
        const TLaid both = laid(*all);
        const std::size_t before = alignment.pairs.size();
        alignment = m_relocator.extended({both.landmarks, both.mean, covariance, both.history,
                                          m_ratio, m_ekf.maxRange, m_ekf.fieldOfView / 2},
                                         alignment);
        if (alignment.pairs.size() <= before) break;
    }
    return true;
}

bool CSalientEKF2D::join(TRelocation& found) {
    auto all = fitting(found.best, true);
    if (!all) return false;
    noteRelocation("joined", found);  // by the ids before the join
    accept(std::move(*all));
    return true;
}

void CSalientEKF2D::accept(TJoined all) {
    std::map<int, int> keptOf;
    for (const auto& [gone, kept] : all.ids) keptOf[gone] = kept;
    for (std::size_t i = 0; i < m_now.landmarks.size(); ++i) {
        if (m_now.landmarks[i] < 0) continue;
        int id = m_landmarks[static_cast<std::size_t>(m_now.landmarks[i])].id;
        const auto merged = keptOf.find(id);
        if (merged != keptOf.end()) {
            id = merged->second;
            m_now.decisions[i] = EDecision::relocated;
        }
        m_now.landmarks[i] = static_cast<int>(all.landmarks.indexOf(id));
    }
    for (const auto& [gone, kept] : all.ids) {
        m_history.rename(gone, kept);
        m_lastUsed[kept] = std::max(m_lastUsed[kept], m_lastUsed[gone]);
        m_lastUsed.erase(gone);
    }
    m_landmarks = std::move(all.landmarks);
    setState(all.smoothed);
    ++m_record.joins;
}

}  // namespace salma::slam
