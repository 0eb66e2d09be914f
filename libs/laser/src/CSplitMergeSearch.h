// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CLineSearch.h"

namespace salma::laser {

/** Lines by split and merge: pieces of the scan are halved at the point farthest from the chord
 * until all lie near, and neighbours that fit one line are joined.
 *
 * Source: V. Nguyen et al., Auton. Robots 23, 2007, algorithm 1 with the split of iterative end
 * point fitting (T. Pavlidis and S. Horowitz, IEEE Trans. Comp. 23, 1974); the scan is cut at jumps
 * as in G. Borges and M. Aldon, J. Intell. Robotic Syst. 40, 2004. */
class CSplitMergeSearch : public CLineSearch {
 public:
    CSplitMergeSearch(const TLineOptions& options, const CFreePoints& points);
    TCandidate next() override;

 private:
    struct TPiece {
        std::size_t first, last;  //!< Of m_order, both included.
    };
    bool isJump(std::uint32_t a, std::uint32_t b) const;
    void split(const TPiece& piece);
    void merge();
    /// The line of least squares, if all points between lie on it.
    std::optional<TFit> lineOf(const TPiece& piece) const;

    const TLineOptions& m_options;
    const CFreePoints& m_points;
    std::vector<std::uint32_t> m_order;  //!< The readings that are used.
    std::vector<TPiece> m_pieces;        //!< The last is next.
};

}  // namespace salma::laser
