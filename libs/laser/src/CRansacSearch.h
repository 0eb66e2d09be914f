// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "CLineSearch.h"

namespace salma::laser {

/** Lines by RANSAC, that with most support first.
 *
 * A hypothesis is the line through two beams near each other. They are drawn for all lines of the
 * scan at once; a hypothesis that loses points to a better one is measured again when its turn
 * comes. When none is left, new ones are drawn among the points that are still free, until that
 * finds nothing. */
class CRansacSearch : public CLineSearch {
 public:
    CRansacSearch(const TLineOptions& options, const CFreePoints& points);
    TCandidate next() override;

 private:
    struct THypothesis {
        TFit fit;
        std::uint32_t seed;
        TRun run;
    };
    bool draw();
    void drawFrom(std::uint32_t i, std::uint32_t span);
    std::uint32_t random();

    const TLineOptions& m_options;
    const CFreePoints& m_points;
    std::uint64_t m_random;  //!< State of the random numbers.
    std::vector<THypothesis> m_hypotheses;
    std::vector<std::uint8_t> m_covered;  //!< Of each point, hypotheses whose runs pass over it.
    bool m_fruitful{true};                //!< The last drawing gave a line.
};

}  // namespace salma::laser
