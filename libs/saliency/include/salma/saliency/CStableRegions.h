// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/saliency/TEllipse.h>

#include <opencv2/core/mat.hpp>
#include <vector>

namespace salma::saliency {

/// Section [mser].
struct TStableRegionsOptions : public config::TStrictOptions<TStableRegionsOptions> {
    int delta{5};     //!< Step of the threshold over which a region's area is compared.
    int minArea{60};  //!< Smallest area [px].
    double maxAreaFraction{0.25};  //!< Largest area, as a fraction of the picture.
    double maxVariation{0.25};     //!< Largest relative change of area over `delta`.
    double minDiversity{0.2};      //!< Smallest relative difference of area to an enclosing region.

    void visit(config::COptionVisitor& v);
};

enum class EPolarity { darkOnBright, brightOnDark };

struct TStableRegion {
    std::vector<cv::Point> pixels;  //!< By row, then column.
    cv::Rect box;                   //!< Smallest upright box that holds all pixels.
    TEllipse ellipse;               //!< Centroid; same second moments as the pixels.
    double meanGrey{0};             //!< 0..255.
    EPolarity polarity{EPolarity::darkOnBright};
};

/** Maximally stable extremal regions of both polarities, by OpenCV, which joins pixels that share
 * a side (4-neighbourhood).
 * Source: J. Matas et al., "Robust wide baseline stereo from MSER", BMVC 2002. */
class CStableRegions {
 public:
    /// \throw std::invalid_argument
    explicit CStableRegions(const TStableRegionsOptions& options = {});

    /** Dark regions first, each polarity by row and column of its first pixel, then by area.
     * \param grey CV_8UC1; smaller than 3x3 gives an empty result.
     * \throw std::invalid_argument for another type of picture. */
    std::vector<TStableRegion> detect(const cv::Mat& grey) const;

    const TStableRegionsOptions& options() const { return m_options; }

 private:
    TStableRegionsOptions m_options;
};

}  // namespace salma::saliency
