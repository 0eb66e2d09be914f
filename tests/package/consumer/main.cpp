// SPDX-License-Identifier: BSD-3-Clause
// What a user of the installed libraries writes: a detector, and a filter to feed.
#include <salma/saliency/CScaleSaliency.h>
#include <salma/slam/CSalientEKF2D.h>

#include <iostream>
#include <opencv2/core.hpp>

int main() {
    cv::Mat picture(120, 160, CV_8U);
    cv::RNG(1).fill(picture, cv::RNG::UNIFORM, 0, 256);
    const auto peaks = salma::saliency::CScaleSaliency().detect(picture);
    salma::slam::CSalientEKF2D filter({}, {});
    filter.process({});
    std::cout << "peaks " << peaks.size() << ", x " << filter.pose().mean.x() << "\n";
}
