// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace salma::saliency {

/// Section [quad].
struct TQuadOptions : public config::TStrictOptions<TQuadOptions> {
    double contrast{5};           //!< Weakest edge that is followed [grey levels per pixel].
    double minSide{12};           //!< Shortest side [px].
    double maxAreaFraction{0.5};  //!< Largest area, as a fraction of the picture.
    double straightness{0.03};    //!< A contour leaves its sides by this share of its length.
    double margin{2};             //!< Corners nearer to the picture's edge are cut off [px].

    void visit(config::COptionVisitor& v);
};

/// A closed contour with four straight sides.
struct TQuad {
    std::array<cv::Point2d, 4> corners;  //!< Clockwise as seen, the one nearest (0, 0) first [px].
    double area{0};                      //!< [px^2]
};

/** Closed contours with four straight sides: candidates for posters and signs.
 *
 * Edges are linked on four levels of contrast and their contours simplified to polygons; convex
 * ones with four corners are kept, of both sides of one edge the outer.
 * Source: the idea of quadrangular landmarks, J.-B. Hayet, F. Lerasle and M. Devy, "A visual
 * landmark framework for indoor mobile robot navigation", ICRA 2002; this way to find them: own,
 * on OpenCV's edges and contours. */
class CQuadrilaterals {
 public:
    /// \throw std::invalid_argument
    explicit CQuadrilaterals(const TQuadOptions& options = {});

    /** Largest first, equal ones by row and column of their first corner.
     * \param grey CV_8UC1; smaller than 8x8 gives an empty result.
     * \throw std::invalid_argument for another type of picture. */
    std::vector<TQuad> detect(const cv::Mat& grey) const;

    const TQuadOptions& options() const { return m_options; }

 private:
    TQuadOptions m_options;
};

}  // namespace salma::saliency
