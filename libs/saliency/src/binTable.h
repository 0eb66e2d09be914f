// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>

#include <opencv2/core/mat.hpp>

namespace salma::saliency {

/// The histogram cell of each grey level [1 x 256], CV_8UC1, for a picture that is not empty.
cv::Mat binTable(const cv::Mat& grey, const TScaleSaliencyOptions& options);

}  // namespace salma::saliency
