// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CQuadrilaterals.h>
#include <salma/saliency/CStableRegions.h>
#include <salma/saliency/TEllipse.h>

#include <opencv2/core/mat.hpp>
#include <vector>

namespace salma::apps {

/** Picture [rows x cols], CV_8UC3, with outlines of `regions`: the first 20 numbered from 1 and
 * coloured from red (first) over green to blue, the others thin and white. \param grey CV_8UC1. */
cv::Mat drawOverlay(const cv::Mat& grey, const std::vector<saliency::TEllipse>& regions);

/// The same for stable regions: dark ones blue, bright ones orange, without numbers.
cv::Mat drawOverlay(const cv::Mat& grey, const std::vector<saliency::TStableRegion>& regions);

/// The same for quadrilaterals: the first 20 numbered and coloured like regions.
cv::Mat drawOverlay(const cv::Mat& grey, const std::vector<saliency::TQuad>& quads);

}  // namespace salma::apps
