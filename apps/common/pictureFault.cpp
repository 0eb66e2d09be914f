// SPDX-License-Identifier: BSD-3-Clause
#include "pictureFault.h"

#include <algorithm>
#include <opencv2/core.hpp>

namespace salma::apps {
namespace {

constexpr double kSame = 2;    // grey values that coding may add to an even area
constexpr double kBlack = 24;  // brightest pixel of a black picture
constexpr int kLeastCut = 8;   // 1/8 of the rows without content: the rest did not come

bool isEven(const cv::Mat& grey) {
    double least = 0, most = 0;
    cv::minMaxLoc(grey, &least, &most);
    return most - least <= kSame;
}

/// Each column has one value from top to bottom, and they are not just too dark or too bright.
bool repeatsOneRow(const cv::Mat& grey) {
    cv::Mat least, most;
    cv::reduce(grey, least, 0, cv::REDUCE_MIN);
    cv::reduce(grey, most, 0, cv::REDUCE_MAX);
    const double mean = cv::mean(grey)[0];
    return cv::norm(most, least, cv::NORM_INF) <= kSame && mean > kSame && mean < 255 - kSame;
}

}  // namespace

std::string faultOf(const cv::Mat& grey) {
    double brightest = 0;
    cv::minMaxLoc(grey, nullptr, &brightest);
    if (brightest < kBlack) return "black";
    if (isEven(grey)) return "of one brightness all over";
    const int lower = std::max(2, grey.rows / kLeastCut);
    // A picture that repeats one row from top to bottom is a test pattern.
    const bool cut = grey.rows > lower && !repeatsOneRow(grey) &&
                     repeatsOneRow(grey.rowRange(grey.rows - lower, grey.rows));
    return cut ? "cut: its lower part is missing" : "";
}

}  // namespace salma::apps
