// SPDX-License-Identifier: BSD-3-Clause
#include <salma/viz/doubtfulPairings.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace salma::viz {
namespace {

using slam::TAssociationRow;
using slam::TCandidateRow;

using Key = std::pair<double, std::size_t>;  // time and index of the observation
using CandidatesByObservation = std::multimap<Key, const TCandidateRow*>;

double evidence(double distance2, double logRatio) {
    return (std::isnan(logRatio) ? 0 : logRatio) - distance2 / 2;
}

TDoubtfulPairing judged(const TAssociationRow& pairing,
                        const CandidatesByObservation& candidates,
                        double gate) {
    TDoubtfulPairing result;
    double best = evidence(gate, 0);
    const auto [first, last] = candidates.equal_range({pairing.time, pairing.observation});
    for (auto it = first; it != last; ++it) {
        const TCandidateRow& other = *it->second;
        if (other.landmark == pairing.landmark || !other.inGate) continue;
        const double its = evidence(other.distance2, other.logRatio);
        if (!(its > best)) continue;
        best = its;
        result.rival = other.landmark;
        result.rivalDistance2 = other.distance2;
        result.rivalLogRatio = other.logRatio;
    }
    result.margin = evidence(pairing.distance2, pairing.logRatio) - best;
    return result;
}

}  // namespace

std::vector<TDoubtfulPairing> doubtfulPairings(const slam::TRunRecord& record,
                                               std::size_t count,
                                               double gate) {
    CandidatesByObservation candidates;
    for (const auto& candidate : record.candidates)
        candidates.emplace(Key(candidate.time, candidate.observation), &candidate);
    std::vector<TDoubtfulPairing> result;
    for (std::size_t row = 0; row < record.associations.size(); ++row) {
        const TAssociationRow& made = record.associations[row];
        const bool paired =
            made.decision == slam::EDecision::paired || made.decision == slam::EDecision::relocated;
        // A pairing that an identity in the log states has no distance.
        if (!paired || made.kind != association::ELandmarkKind::salient ||
            std::isnan(made.distance2))
            continue;
        result.push_back(judged(made, candidates, gate));
        result.back().row = row;
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& a, const auto& b) { return a.margin < b.margin; });
    result.resize(std::min(count, result.size()));
    return result;
}

}  // namespace salma::viz
