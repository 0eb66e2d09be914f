// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>

namespace salma::saliency::test {

/// The definition of scale saliency written out pixel by pixel, with nothing shared with the
/// library: the oracle of its tests. \param grey CV_8UC1.
std::vector<observations::TSalientRegion> referenceScaleSaliency(
    const cv::Mat& grey, const TScaleSaliencyOptions& options);

}  // namespace salma::saliency::test
