// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/config/TStrictOptions.h>
#include <salma/laser/TLine.h>

#include <cstddef>
#include <vector>

namespace salma::laser {

/// How the lines of a scan are found.
enum class ELineMethod { ransac, splitMerge };

/// Section [lines] of config.ini.
struct TLineOptions : public config::TStrictOptions<TLineOptions> {
    ELineMethod method{ELineMethod::ransac};
    double inlier{0.025};       //!< Points this near belong to a line [m].
    double gap{0.25};           //!< A hole longer than this along a line splits it [m].
    double minLength{0.05};     //!< Shorter pieces are refused; a door jamb is 0.12 [m].
    int minPoints{4};           //!< Pieces with fewer points are refused.
    int hypotheses{100};        //!< RANSAC samples of a scan; of what is left, at most so many.
    int window{20};             //!< The two points of a sample are at most this many beams apart.
    double maxRange{20};        //!< Longer ranges are not used [m].
    double rangeSigma{0.005};   //!< Noise of a range; the record's own sigma, if larger [m].
    double rangeQuantum{0.01};  //!< Step in which the scanner rounds ranges [m].
    double bearingSigma{mrpt::DEG2RAD(0.05)};  //!< Noise of a beam's direction [rad].
    int seed{1};                               //!< Of the RANSAC samples.

    void visit(config::COptionVisitor& v);
};

/// Which ends of a line are edges of the wall itself: the next beams meet something behind it.
struct TFreeEnds {
    bool from{false};
    bool to{false};
};

/// Lines, and what became of the other points.
struct TLineResult {
    std::vector<TLine> lines;         //!< Robot frame, in counter-clockwise order of their `from`.
    std::vector<TFreeEnds> freeEnds;  //!< Of each line.
    std::size_t validPoints{0};       //!< Readings that were used.
    std::size_t invalidPoints{0};     //!< Readings marked invalid, not finite, zero or too long.
    std::size_t loosePoints{0};       //!< Used readings that lie on no line.
    std::size_t refusedPoints{0};     //!< Pieces with fewer points than `min_points`.
    std::size_t refusedShort{0};      //!< Pieces shorter than `min_length_m`.
    bool tilted{false};       //!< The scanner is not level within 10 deg: nothing extracted.
    bool constant{false};     //!< All readings are equal, as of a dead scanner: nothing extracted.
    bool badGeometry{false};  //!< Aperture not in (0, 360] deg, or place of the scanner not finite:
                              //!< nothing extracted.
    mrpt::math::TPoint2D sensor;  //!< Where the scanner stands in the robot frame [m].
    double beamStep{0};           //!< Angle between neighbouring beams [rad].
    double rangeSigma{0};         //!< Noise of a range, with its rounding [m].
    double bearingSigma{0};       //!< Noise of a beam's direction [rad].
};

/** Straight pieces of wall in one scan of a level 2-D laser.
 *
 * Lines are found by RANSAC, or by split and merge for comparison (`method`), and then treated
 * alike. RANSAC: a hypothesis is the line through two beams near each other, its support the
 * unbroken run of points within `inlier_m` around them. The hypothesis with most support is refined
 * by weighted total least squares and grown again until it is stable; its points are removed, and
 * so on. The covariance of (rho, alpha) follows from the noise of range and bearing of the points.
 * A scanner mounted upside down is understood from its sensor pose. Deterministic: the same scan
 * gives the same lines. docs/laser.md has definitions and figures.
 * Source: M. Fischler and R. Bolles, "Random sample consensus", Comm. ACM 24(6), 1981; S. Pfister,
 * S. Roumeliotis and J. Burdick, "Weighted line fitting algorithms for mobile robot map building",
 * ICRA 2003 (weights; the refinement here is Gauss-Newton on the same cost). */
class CLineExtractor {
 public:
    /// \throw std::invalid_argument if the options contradict each other.
    explicit CLineExtractor(const TLineOptions& options = {});

    /** \param scan With the scanner's pose on the robot in `sensorPose`.
     * \return No lines if nothing straight is seen, e.g. in an empty scan. */
    TLineResult extract(const mrpt::obs::CObservation2DRangeScan& scan) const;

    const TLineOptions& options() const { return m_options; }

 private:
    TLineOptions m_options;
};

}  // namespace salma::laser
