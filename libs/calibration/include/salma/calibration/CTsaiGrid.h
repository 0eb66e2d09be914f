// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/calibration/CCameraMatrix.h>
#include <salma/config/TStrictOptions.h>

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace salma::calibration {

/// Section [tsai_grid]. Pixels are those of the picture at working size.
struct TTsaiOptions : public config::TStrictOptions<TTsaiOptions> {
    int workingSize{1440};   //!< [px] Larger pictures are made so large at most.
    double smoothing{1.2};   //!< [px] Before Canny's detector.
    double lowContrast{30};  //!< Canny's lower threshold; the upper one is twice it.
    double bend{2};          //!< [px] Edges that bend more are cut there.
    double minLength{12};    //!< [px] Shorter pieces are not used.
    int minPoints{28};       //!< Fewer corners are no grid.
    double outlier{4};       //!< Corners that miss by more of the robust deviation are left out.

    void visit(config::COptionVisitor& v);
};

/** What one photograph of two checkerboards at right angles gives.
 *
 * World: x along the fold, y up the board that is seen above it, z along the other one, away from
 * the first; the origin is on the fold at the leftmost corner that was found. */
struct TTsaiResult {
    CCameraMatrix camera;               //!< Refined.
    double linearRms{0};                //!< [px] Of the direct linear transform.
    std::vector<TSpacePoint> points;    //!< That were used.
    std::vector<TSpacePoint> outliers;  //!< Left out.
};

/** Camera from one photograph of a Tsai grid: two checkerboards of equal squares at right angles,
 * whose pattern goes on across the fold.
 *
 * Canny's edges are linked and cut into straight pieces; pieces that meet make corners, and corners
 * that pieces join make a lattice. Each line of the lattice, on either board, is fitted to all of
 * its edge points; corners are the intersections. Which row is the fold is what fits best. Then P
 * by the normalised direct linear transform, refinement, and K, R, t by RQ. Source: K.-L. Ho,
 * transfer report, Oxford 2004, section 4.4 and figure 4.15. */
class CTsaiGrid {
 public:
    explicit CTsaiGrid(const TTsaiOptions& options = {});

    /** \param grey CV_8UC1. \param square Side of a square [m].
     * \throw std::invalid_argument for another type of picture or a side not above 0;
     * std::runtime_error if there is no such grid: too few corners, or all on one board. */
    TTsaiResult calibrate(const cv::Mat& grey, double square) const;

 private:
    TTsaiOptions m_options;
};

}  // namespace salma::calibration
