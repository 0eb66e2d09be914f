// SPDX-License-Identifier: BSD-3-Clause
#include <salma/landmarks/CEntityDetector.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace salma::landmarks {
namespace {

using observations::TSalientRegion;

/// Corners of a quadrilateral stand for its inside when they are drawn to the centre by this share.
constexpr double kInside = 0.1;

/// Darker pictures hold too few grey levels to be brightened more.
constexpr double kMaxGain = 4;

/// A contour's points have no size of their own; they touch nothing.
constexpr double kPoint = 0.5;

/// Centre and four points near the corners, at whole pixels so that an area can hold them.
std::vector<TSalientRegion> pointsOf(const saliency::TQuad& quad) {
    cv::Point2d centre(0, 0);
    for (const auto& corner : quad.corners) centre += corner / 4;
    std::vector<TSalientRegion> points;
    const auto add = [&](const cv::Point2d& p) {
        points.push_back({std::round(p.x), std::round(p.y), kPoint, 0, 0, 0});
    };
    add(centre);
    for (const auto& corner : quad.corners) add(corner + (centre - corner) * kInside);
    return points;
}

}  // namespace

CEntityDetector::CEntityDetector(const TDetectionOptions& options)
    : m_detector(options.selection.detector),
      m_yMin(options.selection.yMin),
      m_brightness(options.selection.brightness),
      m_saliency(options.saliency),
      m_clusterer(saliency::createClusterer(options.clustering)),
      m_stable(options.mser),
      m_quads(options.quad),
      m_external(options.external) {
    if (m_detector == EDetector::external && options.external.command.empty())
        throw std::invalid_argument("detector = external needs a command in [external]");
}

/// The picture, its grey levels multiplied so that their mean is as large as wanted.
cv::Mat CEntityDetector::bright(const cv::Mat& grey) const {
    const double mean = cv::mean(grey)[0];
    if (!(mean > 0 && mean < m_brightness)) return grey;
    cv::Mat brighter;
    grey.convertTo(brighter, CV_8U, std::min(kMaxGain, m_brightness / mean));
    return brighter;
}

TDetections CEntityDetector::detect(const cv::Mat& picture) const {
    if (picture.type() != CV_8UC1)
        throw std::invalid_argument("entities: the picture is not 8-bit grey");
    const cv::Mat grey = bright(picture);
    TDetections out;
    switch (m_detector) {
        case EDetector::scaleSaliency:
            out.regions = salientRegions(grey);
            break;
        case EDetector::mser:
            addStable(grey, true, out);
            break;
        case EDetector::both:
            out.regions = salientRegions(grey);
            if (out.regions.size() > 1) addStable(grey, false, out);
            break;
        case EDetector::quad:
            addQuads(grey, out);
            break;
        case EDetector::external:
            for (const auto& e : m_external.detect(grey))
                out.regions.push_back({e.u, e.v, e.radius(), 0, 0, 0});
    }
    return out;
}

std::vector<TSalientRegion> CEntityDetector::salientRegions(const cv::Mat& grey) const {
    return m_clusterer->cluster(m_saliency.detect(grey, {m_yMin})).regions;
}

void CEntityDetector::addStable(const cv::Mat& grey, bool asRegions, TDetections& out) const {
    const auto& scales = m_saliency.options();
    for (auto& region : m_stable.detect(grey)) {
        const double radius = region.ellipse.radius();
        if (asRegions && radius >= scales.scaleMin && radius <= scales.scaleMax)
            out.regions.push_back({region.ellipse.u, region.ellipse.v, radius, 0, 0, 0});
        out.areas.push_back(std::move(region.pixels));
    }
}

void CEntityDetector::addQuads(const cv::Mat& grey, TDetections& out) const {
    for (const auto& quad : m_quads.detect(grey)) {
        std::vector<cv::Point> area;
        for (const auto& point : pointsOf(quad)) {
            area.emplace_back(static_cast<int>(point.x), static_cast<int>(point.y));
            out.regions.push_back(point);
        }
        out.areas.push_back(std::move(area));
    }
}

}  // namespace salma::landmarks
