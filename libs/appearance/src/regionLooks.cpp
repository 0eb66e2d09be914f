// SPDX-License-Identifier: BSD-3-Clause
#include "regionLooks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace salma::appearance {
namespace {

constexpr int kGrid = 8;
constexpr double kResolution = 100;  // [px/m]
constexpr double kSoftness = 0.02;   // to which the views are made equally soft [m]
constexpr double kPixelBlur = 0.5;   // what one pixel smears [px]
constexpr double kRadii = 1.2;       // half the side of the surroundings [radii of the region]
constexpr double kLeastSide = 0.07;  // but at least [m]

cv::Mat softened(const observations::TPatch& patch) {
    const cv::Size size(std::max(2, static_cast<int>(std::lround(patch.width * kResolution))),
                        std::max(2, static_cast<int>(std::lround(patch.height * kResolution))));
    cv::Mat grey;
    patch.picture.asCvMatRef().convertTo(grey, CV_32F);
    const bool finer = patch.pixelsPerMetre > kResolution;
    cv::resize(grey, grey, size, 0, 0, finer ? cv::INTER_AREA : cv::INTER_CUBIC);
    const double own = kPixelBlur / std::min(patch.pixelsPerMetre, kResolution);
    const double missing =
        kResolution * std::sqrt(std::max(0.0, kSoftness * kSoftness - own * own));
    if (missing > 0.1) cv::GaussianBlur(grey, grey, {}, missing, missing, cv::BORDER_REPLICATE);
    return grey;
}

float between(const cv::Mat& grey, double x, double y) {
    x = std::clamp(x, 0.0, grey.cols - 1.001);
    y = std::clamp(y, 0.0, grey.rows - 1.001);
    const int c = static_cast<int>(x);
    const int r = static_cast<int>(y);
    const auto fx = static_cast<float>(x - c);
    const auto fy = static_cast<float>(y - r);
    const auto* upper = grey.ptr<float>(r);
    const auto* lower = grey.ptr<float>(r + 1);
    return (upper[c] * (1 - fx) + upper[c + 1] * fx) * (1 - fy) +
           (lower[c] * (1 - fx) + lower[c + 1] * fx) * fy;
}

RegionLook lookAt(const cv::Mat& grey, const observations::TSalientRegion& region) {
    RegionLook look;
    const double half = std::max(kRadii * region.s, kLeastSide);
    for (int row = 0; row < kGrid; ++row)
        for (int col = 0; col < kGrid; ++col) {
            const double x = region.x + half * (2 * (col + 0.5) / kGrid - 1);
            const double y = region.y - half * (2 * (row + 0.5) / kGrid - 1);
            look[static_cast<std::size_t>(row * kGrid + col)] =
                between(grey, (grey.cols - 1) / 2.0 + x * kResolution,
                        (grey.rows - 1) / 2.0 - y * kResolution);
        }
    const float mean = std::accumulate(look.begin(), look.end(), 0.0F) / look.size();
    for (auto& g : look) g -= mean;
    const float norm = std::sqrt(std::inner_product(look.begin(), look.end(), look.begin(), 0.0F));
    for (auto& g : look) g = norm > 1 ? g / norm : 0;
    return look;
}

}  // namespace

std::vector<RegionLook> regionLooks(const observations::TPatch& patch) {
    std::vector<RegionLook> looks;
    if (patch.picture.isEmpty() || !(patch.width < 20) || !(patch.height < 20) ||
        !(patch.pixelsPerMetre > 0))
        return looks;
    const cv::Mat grey = softened(patch);
    looks.reserve(patch.regions.size());
    for (const auto& region : patch.regions) looks.push_back(lookAt(grey, region));
    return looks;
}

double correlation(const RegionLook& a, const RegionLook& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0F);
}

}  // namespace salma::appearance
