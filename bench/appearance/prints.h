// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "CPosterViews.h"

namespace salma::bench {

/// The middle of a print: `share` of its width and height.
cv::Mat cropped(const cv::Mat& print, double share);

/// A poster of a series: head line, frame and foot are those of all, the picture is its own.
cv::Mat ofSeries(const cv::Mat& picture);

/// Door plates and exit signs, 400 px high: a few letters or an arrow on one colour.
std::vector<cv::Mat> plainSigns();

/// Hides the right part of a view's print, this share of it, behind somebody in two greys.
void hide(TPosterView& view, double share);

}  // namespace salma::bench
