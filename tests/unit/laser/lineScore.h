// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/CLineExtractor.h>

#include <vector>

/// How well lines agree with what a simulated scanner saw.
namespace salma::laser::test {

/// A wall, and what a scan sees of it without a hole.
struct TTrueLine {
    double rho{0}, alpha{0};         //!< Robot frame [m], [rad].
    std::vector<std::size_t> beams;  //!< Readings that hit it, in order.
    double length{0};                //!< From the first of these to the last [m].
};

/// A wall in the robot frame, by two of its points.
struct TTrueWall {
    mrpt::math::TPoint2D a, b;
};

/** What an extractor could find: runs of readings that hit one wall (collinear pieces are one)
 * without a hole longer than `options.gap` along it.
 * \param hits For each reading the index of its wall, -1 for none or if it is beyond
 * `options.maxRange`. */
std::vector<TTrueLine> trueLines(const std::vector<TTrueWall>& walls,
                                 const std::vector<int>& hits,
                                 const mrpt::obs::CObservation2DRangeScan& scan,
                                 const TLineOptions& options);

/// Which true lines must be found.
struct TRequired {
    std::size_t points{9};
    double length{0.5};  //!< [m]
};

/** Counts over scans, as in V. Nguyen, S. Gaechter, A. Martinelli, N. Tomatis and R. Siegwart, "A
 * comparison of line extraction algorithms using 2D range data for indoor mobile robotics", Auton.
 * Robots 23, 2007: true positives = matches / true lines, false positives = 1 - matches / lines.
 *
 * A line and a true line match if half of the one's points and half of the other's are common and
 * both ends lie within 3 cm of the wall; each is matched once, those with most in common first. A
 * line that matches a true line smaller than required is neither right nor false. */
struct TLineScore {
    std::size_t scans{0};
    std::size_t required{0};  //!< True lines that must be found.
    std::size_t found{0};
    std::size_t lines{0};  //!< Extracted ones of the required size, without those that match less.
    std::size_t wrong{0};  //!< Of these, those that match nothing.
    std::size_t compared{0};  //!< All matches, whatever their size.
    double nees{0};           //!< Sum over them of the squared Mahalanobis error of (rho, alpha).

    double falsePart() const { return lines > 0 ? double(wrong) / double(lines) : 0; }
    double missedPart() const { return required > 0 ? 1 - double(found) / double(required) : 0; }
};

void addScore(const TLineResult& result,
              const std::vector<TTrueLine>& truth,
              const TRequired& required,
              TLineScore& score);

}  // namespace salma::laser::test
