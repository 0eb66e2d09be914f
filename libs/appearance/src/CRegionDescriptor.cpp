// SPDX-License-Identifier: BSD-3-Clause
#include <salma/appearance/CRegionDescriptor.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "sampleWall.h"

namespace salma::appearance {
namespace {

constexpr double kLeastContrast = 2;  // calmer walls hold nothing but noise [grey levels]
constexpr double kPixelBlur = 0.5;    // what one pixel of lens and sampling smears [px]

saliency::TScaleSaliencyOptions saliencyOptions(const TSecondLookOptions& options) {
    saliency::TScaleSaliencyOptions out;
    out.scaleMin = options.scaleMin;
    out.scaleMax = options.scaleMax;
    return out;
}

}  // namespace

void TSecondLookOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.number("px_per_m", pixelsPerMetre, between(20, 400),
             "resolution in which all patches are looked at");
    v.number("blur_m", blur, between(0, 0.1), "softness that all views are brought to");
    v.integer("scale_min_px", scaleMin, between(1, 126), "smallest radius, in that resolution");
    v.integer("scale_max_px", scaleMax, between(3, 128), "largest radius, in that resolution");
    v.number("y_min", yMin, atLeast(0), "least saliency Y of a region [nat]");
    v.number("contrast", contrast, moreThan(0),
             "standard deviation that a patch is brought to, in grey levels");
}

void TSecondLookOptions::validate() const { saliencyOptions(*this).validate(); }

CRegionDescriptor::CRegionDescriptor(const TSecondLookOptions& options)
    : m_options(options), m_saliency(saliencyOptions(options)) {
    m_options.validate();
}

cv::Mat CRegionDescriptor::normalised(const cv::Mat& grey,
                                      const CWallView& view,
                                      const TWallRectangle& r,
                                      int margin) const {
    const double ppm = m_options.pixelsPerMetre;
    const cv::Size inner(static_cast<int>(std::lround((r.u1 - r.u0) * ppm)),
                         static_cast<int>(std::lround((r.v1 - r.v0) * ppm)));
    const double beyondU = margin * (r.u1 - r.u0) / inner.width;
    const double beyondV = margin * (r.v1 - r.v0) / inner.height;
    const TWallRectangle wide{r.u0 - beyondU, r.v0 - beyondV, r.u1 + beyondU, r.v1 + beyondV};
    cv::Mat wall =
        sampleWall(grey, view, wide, {inner.width + 2 * margin, inner.height + 2 * margin}).grey;
    wall.convertTo(wall, CV_32F);
    const auto seen = view.pixelsPerMetreOfAxes((r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2);
    const auto missing = [&](double resolution) {  // softness still to be added [px]
        const double own = kPixelBlur / std::min(resolution, ppm);
        return ppm * std::sqrt(std::max(0.0, m_options.blur * m_options.blur - own * own));
    };
    const double sx = missing(seen.first), sy = missing(seen.second);
    if (sx > 0.1 || sy > 0.1)
        cv::GaussianBlur(wall, wall, {}, std::max(sx, 0.1), std::max(sy, 0.1));
    cv::Scalar mean, deviation;
    cv::meanStdDev(wall({margin, margin, inner.width, inner.height}), mean, deviation);
    if (!(deviation[0] >= kLeastContrast)) return {};
    const double gain = m_options.contrast / deviation[0];
    wall.convertTo(wall, CV_8U, gain, 127.5 - gain * mean[0]);
    return wall;
}

std::vector<observations::TSalientRegion> CRegionDescriptor::describe(
    const cv::Mat& grey, const CWallView& view, const TWallRectangle& r) const {
    const double width = r.u1 - r.u0;
    const double height = r.v1 - r.v0;
    const double ppm = m_options.pixelsPerMetre;
    if (grey.empty() || !(std::min(width, height) * ppm >= 1) || !(std::max(width, height) < 20) ||
        !view.toPixel((r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2))
        return {};
    const int margin = m_options.scaleMax;  // the detector has no centres nearer to the border
    const cv::Mat wall = normalised(grey, view, r, margin);
    if (wall.empty()) return {};
    auto regions = m_clusterer.cluster(m_saliency.detect(wall, {m_options.yMin})).regions;
    const double pixelU = width / (wall.cols - 2 * margin);
    const double pixelV = height / (wall.rows - 2 * margin);
    for (auto& region : regions) {
        region.x = (region.x - (wall.cols - 1) / 2.0) * pixelU;
        region.y = ((wall.rows - 1) / 2.0 - region.y) * pixelV;
        region.s /= ppm;
    }
    const auto seen = [&](const auto& region) {
        if (!(std::abs(region.x) <= width / 2 && std::abs(region.y) <= height / 2)) return false;
        const auto pixel = view.toPixel((r.u0 + r.u1) / 2 + region.x, (r.v0 + r.v1) / 2 + region.y);
        return pixel && view.inPicture(*pixel);
    };
    regions.erase(std::remove_if(regions.begin(), regions.end(), std::not_fn(seen)), regions.end());
    return regions;
}

}  // namespace salma::appearance
