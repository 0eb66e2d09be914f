// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/config/TStrictOptions.h>
#include <salma/laser/CLineExtractor.h>
#include <salma/laser/TPlanePatch.h>

#include <vector>

namespace salma::laser {

/// Section [planes].
struct TPlaneOptions : public config::TStrictOptions<TPlaneOptions> {
    double inlier{0.03};    //!< Both ends of a line on a plane are this near to it [m].
    double gap{1.5};        //!< Lines farther apart on a plane belong to different pieces [m].
    double minLength{0.1};  //!< Shorter lines are not used [m].
    int minLines{4};        //!< Pieces with fewer lines are refused.
    int minPoints{50};      //!< Pieces with fewer points are refused.
    double minSize{0.12};   //!< Pieces narrower than this are refused [m].
    int hypotheses{300};    //!< RANSAC samples for each plane.
    int window{12};         //!< The two lines of a sample come from scans at most this many apart.
    double tilt{mrpt::DEG2RAD(8.0)};  //!< Upright and level planes are so within this [rad].
    double behind{0.6};               //!< A wall so close behind an upright plane ... [m]
    double above{0.2};         //!< ... that rises so much above it makes it a protrusion [m].
    double rangeSigma{0.005};  //!< Noise of a range [m].
    double bearingSigma{mrpt::DEG2RAD(0.05)};  //!< Noise of a beam's direction, either way [rad].
    int seed{1};                               //!< Of the RANSAC samples.

    void visit(config::COptionVisitor& v);
};

/// Planes, and what became of the scans.
struct TPlaneResult {
    std::vector<TPlanePatch> planes;   //!< Robot frame, those with most points first.
    std::size_t lines{0};              //!< Lines of all scans.
    std::size_t looseLines{0};         //!< Of these, those on no plane.
    std::size_t scansWithoutLines{0};  //!< Empty, constant or otherwise unusable scans too.
};

/** Walls, floor, ceiling and what stands out from them, in the scans of a nodding laser.
 *
 * Lines are found in each scan, then planes among the lines: a hypothesis is the plane through a
 * line and the middle of one from a scan beside it, or the one through a line that is parallel to a
 * plane found before; its support are the lines that lie on it with both ends. The connected piece
 * with most points is fitted by weighted least squares to all points of its lines, gathered again
 * until it is stable, and taken away; and so on. Deterministic. Source: K.-L. Ho, transfer report,
 * Oxford, 2004, section 4.4.1 (lines first, then RANSAC over lines); parallel planes, connection,
 * refinement, covariance and kinds: own. */
class CPlaneExtractor {
 public:
    /// \throw std::invalid_argument if options are out of range.
    explicit CPlaneExtractor(const TPlaneOptions& options = {});

    /** \param scans Of one sweep, in its order, each with its own `sensorPose` on the robot (pitch
     * is the nodding). \return No planes for fewer than two scans with lines.
     * \throw std::invalid_argument naming the scan if its pose or aperture is not finite or it has
     * another number of readings than the first. */
    TPlaneResult extract(const std::vector<mrpt::obs::CObservation2DRangeScan>& scans) const;

    const TPlaneOptions& options() const { return m_options; }

 private:
    TPlaneOptions m_options;
    CLineExtractor m_lines;
};

}  // namespace salma::laser
