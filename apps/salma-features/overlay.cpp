// SPDX-License-Identifier: BSD-3-Clause
#include "overlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

namespace salma::apps {
namespace {

constexpr std::size_t kRanked = 20;

/// Red for rank 0 to blue for the last one that is coloured.
cv::Scalar colourOf(std::size_t rank) {
    cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(120.0 * static_cast<double>(rank) / kRanked, 255, 255));
    cv::cvtColor(pixel, pixel, cv::COLOR_HSV2BGR);
    return pixel.at<cv::Vec3b>(0);
}

void outline(cv::Mat& picture,
             const saliency::TEllipse& e,
             const cv::Scalar& colour,
             int thickness) {
    // Half axes are 1/sqrt of the eigenvalues of [a b; b c]; the smaller one has the longer axis.
    const double mean = (e.a + e.c) / 2;
    const double difference = std::hypot((e.a - e.c) / 2, e.b);
    const double angle = 90 + std::atan2(2 * e.b, e.a - e.c) / 2 * 180 / CV_PI;
    const cv::Size2d axes(2 / std::sqrt(mean - difference), 2 / std::sqrt(mean + difference));
    const cv::RotatedRect box(cv::Point2d(e.u, e.v), axes, static_cast<float>(angle));
    cv::ellipse(picture, box, colour, thickness, cv::LINE_AA);
}

void number(cv::Mat& picture, const cv::Point& place, std::size_t rank) {
    const std::string text = std::to_string(rank + 1);
    const auto font = cv::FONT_HERSHEY_SIMPLEX;
    cv::putText(picture, text, place, font, 0.4, cv::Scalar(0, 0, 0), 3, cv::LINE_AA);
    cv::putText(picture, text, place, font, 0.4, colourOf(rank), 1, cv::LINE_AA);
}

cv::Point besideOf(const saliency::TEllipse& region) {
    const double corner = region.radius() * 0.7;
    return cv::Point2d(region.u + corner + 2, region.v - corner);
}

cv::Mat inColour(const cv::Mat& grey) {
    cv::Mat picture;
    cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
    return picture;
}

}  // namespace

cv::Mat drawOverlay(const cv::Mat& grey, const std::vector<saliency::TEllipse>& regions) {
    cv::Mat picture = inColour(grey);
    const std::size_t ranked = std::min(kRanked, regions.size());
    for (std::size_t i = ranked; i < regions.size(); ++i)
        outline(picture, regions[i], cv::Scalar::all(255), 1);
    for (std::size_t i = ranked; i-- > 0;) outline(picture, regions[i], colourOf(i), 2);
    for (std::size_t i = ranked; i-- > 0;) number(picture, besideOf(regions[i]), i);
    return picture;
}

cv::Mat drawOverlay(const cv::Mat& grey, const std::vector<saliency::TStableRegion>& regions) {
    cv::Mat picture = inColour(grey);
    for (const auto& region : regions) {
        const bool dark = region.polarity == saliency::EPolarity::darkOnBright;
        outline(picture, region.ellipse, dark ? cv::Scalar(255, 80, 0) : cv::Scalar(0, 140, 255),
                1);
    }
    return picture;
}

cv::Mat drawOverlay(const cv::Mat& grey, const std::vector<saliency::TQuad>& quads) {
    cv::Mat picture = inColour(grey);
    for (std::size_t i = quads.size(); i-- > 0;) {
        const auto& c = quads[i].corners;
        const std::vector<cv::Point> outline(c.begin(), c.end());
        const bool ranked = i < kRanked;
        cv::polylines(picture, outline, true, ranked ? colourOf(i) : cv::Scalar::all(255),
                      ranked ? 2 : 1, cv::LINE_AA);
        if (ranked) number(picture, outline[1] + cv::Point(4, 0), i);
    }
    return picture;
}

}  // namespace salma::apps
