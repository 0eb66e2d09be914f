// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CRectifier.h>
#include <salma/appearance/CWallView.h>
#include <salma/config/TStrictOptions.h>
#include <salma/observations/TSalientRegion.h>
#include <salma/saliency/CGreedyClusterer.h>
#include <salma/saliency/CScaleSaliency.h>

#include <opencv2/core/mat.hpp>
#include <vector>

namespace salma::appearance {

/// Section [second_look] of config.ini.
struct TSecondLookOptions : public config::TStrictOptions<TSecondLookOptions> {
    double pixelsPerMetre{120};  //!< Resolution in which all patches are looked at [px/m].
    double blur{0.015};          //!< To which all views are made equally soft [m].
    int scaleMin{3};             //!< Smallest radius of a region [px of that resolution].
    int scaleMax{24};            //!< Largest [px of that resolution].
    double yMin{0.8};            //!< Least saliency [nat].
    double contrast{50};         //!< Standard deviation that the patch is brought to [grey levels].

    void visit(config::COptionVisitor& v);
    void validate() const;
};

/** The second look: salient regions of a piece of wall, in metres on it.
 *
 * They are sought where the wall is seen from straight ahead, in one resolution, softness and
 * contrast whatever the view: then they are the same from near and far, left and right, by lamp
 * and by daylight.
 * Source: K.-L. Ho, transfer report, Oxford 2004, sections 4.1.2 and 4.6; the common resolution
 * and contrast: own. */
class CRegionDescriptor {
 public:
    /// \throw std::invalid_argument if the options are out of range.
    explicit CRegionDescriptor(const TSecondLookOptions& options = {});

    /** \param grey [rows x cols], CV_8UC1, as the camera of `view` delivers it.
     * \return Most salient first: centre (x right, y up) and radius s [m] in the patch frame, that
     * is from the rectangle's centre; H, W, Y as the detector has them. None lies where the
     * rectangle reaches out of the picture. Empty for a wall of one
     * grey, and for a rectangle that is empty, not finite or not seen. */
    std::vector<observations::TSalientRegion> describe(const cv::Mat& grey,
                                                       const CWallView& view,
                                                       const TWallRectangle& rectangle) const;

    const TSecondLookOptions& options() const { return m_options; }

 private:
    cv::Mat normalised(const cv::Mat& grey,
                       const CWallView& view,
                       const TWallRectangle& rectangle,
                       int margin) const;

    TSecondLookOptions m_options;
    saliency::CScaleSaliency m_saliency;
    saliency::CGreedyClusterer m_clusterer;
};

}  // namespace salma::appearance
