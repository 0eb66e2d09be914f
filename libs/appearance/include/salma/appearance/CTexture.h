// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CRectifier.h>
#include <salma/appearance/CWallView.h>
#include <salma/config/TStrictOptions.h>

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace salma::appearance {

/// Section [texture] of config.ini.
struct TTextureOptions : public config::TStrictOptions<TTextureOptions> {
    double pixelsPerMetre{40};  //!< Resolution for all walls; finer views are averaged [px/m].
    double margin{0.3};         //!< How far around the entity the wall is looked at [m].
    double gap{0.02};           //!< So far from the entity's border it begins: frames [m].
    int minPixels{300};         //!< Fewer say nothing.

    void visit(config::COptionVisitor& v);
};

/** What the wall around an entity is like: brick, wood, plaster.
 *
 * Two joint histograms, of which each holds half of the mass: rotation-invariant uniform local
 * binary pattern and local contrast (deviation over mean, five classes), on 8 neighbours at 1 px
 * and on 16 at 2 px. Neither brightness nor gain nor a turn of the wall changes it; scale does not
 * either, since the wall is sampled in metres.
 * Source: T. Ojala, M. Pietikainen and T. Maenpaa, "Multiresolution gray-scale and rotation
 * invariant texture classification with local binary patterns", PAMI 24(7), 2002; their VAR,
 * divided by the mean to withstand gain, joint with LBP riu2. */
class CTexture {
 public:
    /// Entries of a histogram: (10 + 18) patterns, 5 contrasts each.
    static constexpr std::size_t kBins = (10 + 18) * 5;

    /// \throw std::invalid_argument if the options are out of range.
    explicit CTexture(const TTextureOptions& options = {});

    /** Of the wall around a rectangle.
     * \param grey [rows x cols], CV_8UC1, as the camera of `view` delivers it.
     * \return kBins entries that sum to 1; empty if too little of the wall is seen. */
    std::vector<float> describe(const cv::Mat& grey,
                                const CWallView& view,
                                const TWallRectangle& rectangle) const;

    /** Of a picture in the resolution of the options.
     * \param wall CV_8UC1 or CV_32FC1. \param mask CV_8UC1 of the same size; where it is 0, the
     * wall is not looked at. Empty: all is wall.
     * \throw std::invalid_argument for other types or sizes. */
    std::vector<float> describe(const cv::Mat& wall, const cv::Mat& mask = {}) const;

    const TTextureOptions& options() const { return m_options; }

 private:
    TTextureOptions m_options;
};

/** Hellinger distance of two histograms, 0 for equal ones to 1; nothing if one is empty or not
 * finite or they are of different sizes. */
std::optional<double> textureDistance(const std::vector<float>& a, const std::vector<float>& b);

}  // namespace salma::appearance
