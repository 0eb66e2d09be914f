// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/observations/TPatch.h>

#include <opencv2/core/mat.hpp>
#include <vector>

namespace salma::appearance {

/// Section [descriptor] of config.ini.
struct TDescriptorOptions : public config::TStrictOptions<TDescriptorOptions> {
    int maxKeypoints{300};           //!< The strongest are kept.
    double contrastThreshold{0.04};  //!< Of SIFT: weaker extrema are dropped.
    double edgeThreshold{10};        //!< Of SIFT: more elongated extrema are dropped.
    double sigma{1.6};               //!< Of SIFT: blur of its first layer [px].

    void visit(config::COptionVisitor& v);
};

/** SIFT keypoints of a patch, in metres on the wall.
 *
 * Source: D. Lowe, "Distinctive image features from scale-invariant keypoints", IJCV 60(2), 2004;
 * computed by cv::SIFT. Deterministic: equal responses are ordered by place. */
class CPatchDescriptor {
 public:
    explicit CPatchDescriptor(const TDescriptorOptions& options = {});

    /// Keypoints of `patch.picture`, strongest first; empty for a patch without picture or content.
    /// A dim patch that gives few is looked at again with more contrast.
    std::vector<observations::TKeypoint> describe(const observations::TPatch& patch) const;

    /** The same for any picture.
     * \param grey [rows x cols], CV_8UC1; its centre becomes the origin.
     * \param pixelsPerMetre 1 leaves places and scales in pixels (y still points up).
     * \throw std::invalid_argument if the type is another or pixelsPerMetre is not positive. */
    std::vector<observations::TKeypoint> describe(const cv::Mat& grey, double pixelsPerMetre) const;

    const TDescriptorOptions& options() const { return m_options; }

 private:
    TDescriptorOptions m_options;
};

}  // namespace salma::appearance
