// SPDX-License-Identifier: BSD-3-Clause
#include "binTable.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace salma::saliency {

cv::Mat binTable(const cv::Mat& grey, const TScaleSaliencyOptions& options) {
    double low = 0;
    double high = 255;
    if (options.stretch) cv::minMaxLoc(grey, &low, &high);
    const double range = std::max(high - low, 1.0);
    cv::Mat table(1, 256, CV_8UC1);
    for (int g = 0; g < 256; ++g) {
        const double cell = (g - low) * (options.bins - 1) / range;
        table.at<std::uint8_t>(g) = cv::saturate_cast<std::uint8_t>(std::lround(cell));
    }
    return table;
}

}  // namespace salma::saliency
