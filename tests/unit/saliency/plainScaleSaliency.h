// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>

namespace salma::saliency::test {

/** Scale saliency by plain loops over the pixels of each ring, with the arithmetic that the library
 * promises: its results are the same to the last digit. \param grey CV_8UC1. */
std::vector<observations::TSalientRegion> plainScaleSaliency(const cv::Mat& grey,
                                                             const TScaleSaliencyOptions& options);

}  // namespace salma::saliency::test
