// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/laser/CLineExtractor.h>

#include <cstddef>
#include <vector>

namespace salma::laser {

/// Section [corners] of config.ini.
struct TCornerOptions : public config::TStrictOptions<TCornerOptions> {
    double minAngle{mrpt::DEG2RAD(45.0)};  //!< Walls that meet at less are no corner [rad].
    double endTolerance{0.06};             //!< A wall's end is at most this far from the corner,
                                           //!< beside one beam spacing [m].
    double maxEndDistance{0.25};           //!< Limit of that sum [m].
    int maxMissingBeams{2};                //!< Beams between the two ends that lie on neither wall.
    double longSide{0.5};                  //!< One of the two walls is at least this long [m].
    int shortSidePoints{4};                //!< The other has at least this many points.
    bool lineEnds{true};  //!< Also where a wall of `long_side_m` ends and the view goes on behind.
    double maxSigma{0.08};    //!< Corners less sure than this are refused [m].
    double sigmaFloor{0.01};  //!< Added in quadrature: rounded edges, skirting [m].

    void visit(config::COptionVisitor& v);
    void validate() const;
};

/// Corners, and why neighbouring lines did not make one.
struct TCornerResult {
    std::vector<TCorner> corners;     //!< Robot frame, counter-clockwise as the scan sees them;
                                      //!< ends of lines, if wanted, come last.
    std::size_t refusedAngle{0};      //!< Nearly parallel.
    std::size_t refusedApart{0};      //!< Ends that do not meet: openings and depth jumps.
    std::size_t refusedSupport{0};    //!< Both walls short, or too few points.
    std::size_t refusedUncertain{0};  //!< Larger sigma than `max_sigma_m`.
};

/** Corners where two neighbouring lines of a scan meet, as landmarks for geometry alone.
 *
 * A corner is the intersection of both lines, not an end of one. The covariance is propagated from
 * both lines and widened by the floor. The face of a door jamb of 0.12 m holds the four points that
 * it needs only near by: with 0.5 deg between beams most jambs come out within 2 m, none beyond 4
 * m. With `line_ends` the edge of a wall before a depth jump counts too, as convex: half a beam
 * spacing beyond the last point, and as uncertain along the wall as the spacing is. In a corridor
 * with recessed doors that gives nearly three times as many. Source: own. */
class CCornerExtractor {
 public:
    /// \throw std::invalid_argument if the options contradict each other.
    explicit CCornerExtractor(const TCornerOptions& options = {});

    /// \return No corners for fewer than two lines.
    TCornerResult extract(const TLineResult& lines) const;

    const TCornerOptions& options() const { return m_options; }

 private:
    void add(TCorner corner, TCornerResult& result) const;
    void addLineEnds(const TLineResult& lines, TCornerResult& result) const;

    TCornerOptions m_options;
};

}  // namespace salma::laser
