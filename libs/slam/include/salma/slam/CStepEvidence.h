// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationProblem.h>
#include <salma/slam/CLandmarkTable.h>

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace salma::slam {

/// When appearance counts again.
struct TEvidenceLimits {
    double decorrelation{0};    //!< Change of the viewing angle, in one track [rad].
    double trackGap{0};         //!< A landmark that was not paired for longer begins a track [s].
    double forbid{0};           //!< Log ratio up to which appearance excludes a candidate.
    double gateQuantile{0.99};  //!< Of a measurement that goes on with a track.
};

/** What appearance says of the pairs of one step, so that nothing is said twice.
 *
 * Views of one pass are not independent: what the first says of a landmark, the next ones repeat.
 * So appearance counts once per track and landmark, and again only after the viewing angle has
 * changed by `decorrelation` since it last counted. A measurement goes on with a track if its
 * landmark was paired not longer than `trackGap` ago, counted at nearly this angle, lies in its
 * gate and is not excluded by appearance. Then
 *  - the log ratio of that landmark is 0: geometry alone counts;
 *  - other landmarks keep what speaks against them, but nothing that speaks for them counts: the
 *    same look has already counted for the landmark of the track, and must not win it for a
 *    look-alike beside it;
 *  - a ratio up to `forbid` stays as it is, also for the landmark of the track: it cannot be the
 *    echo of an earlier view, which spoke for the pairing. Something else hangs there.
 *
 * A landmark that has look-alikes in the map may have more outside: with q, their share of the
 * map's salient landmarks, p(score|other) is a mixture once more, and the ratio stays below 1/q.
 * With the matcher's own duplicate rate this makes LR <= 1/pi, pi = 1 - (1 - duplicate_rate)(1 -
 * q). Ratios below 1 are not changed. Source: own. */
class CStepEvidence {
 public:
    /** Nothing is kept of `problem`; the other arguments must outlive this object.
     * \param problem Its measurements and predictions; `logRatio` is not used.
     * \param selected Indices in the table of the problem's landmarks; empty: all, in order. */
    CStepEvidence(const TEvidenceLimits& limits,
                  const CLandmarkTable& landmarks,
                  const PatchRatio& ratio,
                  const association::TAssociationProblem& problem,
                  double time,
                  std::vector<std::size_t> selected = {});

    /// Log likelihood ratio that counts; NaN where appearance cannot tell. Landmarks are counted
    /// as the problem does.
    double logRatio(std::size_t observation, std::size_t landmark);

    /// True if a pairing uses the appearance up: it has one, and does not go on with a track.
    bool counts(std::size_t observation, std::size_t landmark);

 private:
    using TPair = std::pair<std::size_t, std::size_t>;
    double raw(std::size_t observation, std::size_t landmark);
    bool isInTrack(std::size_t observation, std::size_t landmark) const;
    /// Index in the table.
    std::size_t inTable(std::size_t landmark) const {
        return m_selected.empty() ? landmark : m_selected[landmark];
    }

    const TEvidenceLimits m_limits;
    const CLandmarkTable& m_landmarks;
    const PatchRatio& m_ratio;
    const double m_time;
    const std::vector<std::size_t> m_selected;
    std::vector<association::TMeasurement> m_measurements;
    std::vector<bool> m_goesOn;  //!< By measurement: with some track.
    std::map<TPair, double> m_raw;
};

}  // namespace salma::slam
