// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/laser/CLineExtractor.h>

#include <cstddef>
#include <vector>

namespace salma::laser {

/// Section [corners] of config.ini.
struct TCornerOptions : public config::TStrictOptions<TCornerOptions> {
    double minAngle{0.785398163397448};  //!< Walls that meet at less are no corner [rad].
    double endTolerance{0.06};           //!< A wall's end is at most this far from the corner,
                                         //!< beside one beam spacing [m].
    double maxEndDistance{0.25};         //!< Limit of that sum [m].
    int maxMissingBeams{2};              //!< Beams between the two ends that lie on neither wall.
    double longSide{0.4};                //!< One of the two walls is at least this long [m].
    int shortSidePoints{5};              //!< The other has at least this many points.
    double maxSigma{0.08};               //!< Corners less sure than this are refused [m].
    double sigmaFloor{0.02};             //!< Added in quadrature: rounded edges, skirting [m].

    void visit(config::COptionVisitor& v);
    void validate() const;
};

/// Corners, and why neighbouring lines did not make one.
struct TCornerResult {
    std::vector<TCorner> corners;     //!< Robot frame, counter-clockwise as the scan sees them.
    std::size_t refusedAngle{0};      //!< Nearly parallel.
    std::size_t refusedApart{0};      //!< Ends that do not meet: openings and depth jumps.
    std::size_t refusedSupport{0};    //!< Both walls short, or too few points.
    std::size_t refusedUncertain{0};  //!< Larger sigma than `max_sigma_m`.
};

/** Corners where two neighbouring lines of a scan meet, as landmarks for geometry alone.
 *
 * A corner is the intersection of both lines, never a line's end: an end moves with the viewpoint.
 * Where a wall ends in a depth jump, nothing is returned. The covariance is propagated from both
 * lines and widened by the floor. A jamb of 0.12 m is a corner only where its face holds enough
 * points: with 0.5 deg between beams up to about 1.2 m from the wall, with 0.25 deg up to 2 m.
 * Source: own. */
class CCornerExtractor {
 public:
    /// \throw std::invalid_argument if the options contradict each other.
    explicit CCornerExtractor(const TCornerOptions& options = {});

    /// \return No corners for fewer than two lines.
    TCornerResult extract(const TLineResult& lines) const;

    const TCornerOptions& options() const { return m_options; }

 private:
    TCornerOptions m_options;
};

}  // namespace salma::laser
