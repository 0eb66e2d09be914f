// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/CQuadrilaterals.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <tuple>

namespace salma::saliency {
namespace {

/// Edges are linked with the weakest contrast times each: what strong edges close, weak ones join
/// to their surroundings.
constexpr double kLevels[] = {8, 4, 2, 1};

/// A Sobel filter of 3x3 adds up to this for one grey level per pixel.
constexpr double kSobelGain = 8;

/// Contours of both sides of one edge, and of two levels, have corners nearer than this [px], or
/// than this share of the quadrilateral's size.
constexpr double kSameCorner = 6, kSameShare = 0.06;

double shortestSide(const TQuad& quad) {
    double shortest = cv::norm(quad.corners[0] - quad.corners[3]);
    for (std::size_t i = 0; i < 3; ++i)
        shortest = std::min(shortest, cv::norm(quad.corners[i + 1] - quad.corners[i]));
    return shortest;
}

/// Clockwise as seen (y down), beginning with the corner nearest to the first pixel.
TQuad ordered(std::vector<cv::Point> corners) {
    if (cv::contourArea(corners, true) < 0) std::reverse(corners.begin(), corners.end());
    const auto first = std::min_element(
        corners.begin(), corners.end(), [](const cv::Point& a, const cv::Point& b) {
            return std::make_tuple(a.x + a.y, a.y) < std::make_tuple(b.x + b.y, b.y);
        });
    std::rotate(corners.begin(), first, corners.end());
    TQuad quad;
    std::copy(corners.begin(), corners.end(), quad.corners.begin());
    quad.area = cv::contourArea(corners);
    return quad;
}

/// The contour as a quadrilateral, if it is one that the options allow.
std::optional<TQuad> asQuad(const std::vector<cv::Point>& contour,
                            const cv::Size& picture,
                            const TQuadOptions& options) {
    const double length = cv::arcLength(contour, true);
    if (!(length >= 4 * options.minSide)) return std::nullopt;
    std::vector<cv::Point> corners;
    cv::approxPolyDP(contour, corners, options.straightness * length, true);
    if (corners.size() != 4 || !cv::isContourConvex(corners)) return std::nullopt;
    for (const auto& p : corners)
        if (!(p.x >= options.margin && p.x <= picture.width - 1 - options.margin &&
              p.y >= options.margin && p.y <= picture.height - 1 - options.margin))
            return std::nullopt;
    const TQuad quad = ordered(corners);
    // A contour that runs along an open line and back has no area.
    if (!(shortestSide(quad) >= options.minSide) ||
        !(std::abs(cv::contourArea(contour)) >= 0.8 * quad.area) ||
        !(quad.area <= options.maxAreaFraction * picture.area()))
        return std::nullopt;
    return quad;
}

bool same(const TQuad& a, const TQuad& b) {
    const double near = std::max(kSameCorner, kSameShare * std::sqrt(a.area));
    for (std::size_t i = 0; i < 4; ++i)
        if (!(cv::norm(a.corners[i] - b.corners[i]) <= near)) return false;
    return true;
}

bool before(const TQuad& a, const TQuad& b) {
    const auto& p = a.corners[0];
    const auto& q = b.corners[0];
    return std::make_tuple(b.area, p.y, p.x) < std::make_tuple(a.area, q.y, q.x);
}

}  // namespace

void TQuadOptions::visit(config::COptionVisitor& v) {
    v.number("contrast", contrast, config::moreThan(0),
             "grey levels per pixel of the weakest edge that is followed");
    v.number("min_side_px", minSide, config::atLeast(4), "shortest side");
    v.number("max_area_fraction", maxAreaFraction, {0, 1, true},
             "largest area, as a fraction of the picture");
    v.number("straightness", straightness, {0, 0.2, true},
             "a contour may leave its sides by this share of its length");
    v.number("margin_px", margin, config::atLeast(0),
             "quadrilaterals nearer to the picture's edge are refused");
}

CQuadrilaterals::CQuadrilaterals(const TQuadOptions& options) : m_options(options) {
    m_options.validate();
}

std::vector<TQuad> CQuadrilaterals::detect(const cv::Mat& grey) const {
    if (grey.type() != CV_8UC1)
        throw std::invalid_argument("quadrilaterals: the picture is not 8-bit grey");
    if (grey.rows < 8 || grey.cols < 8) return {};
    cv::Mat smooth;
    cv::GaussianBlur(grey, smooth, {5, 5}, 1.0);
    std::vector<TQuad> all;
    for (const double level : kLevels) {
        const double strong = level * m_options.contrast * kSobelGain;
        cv::Mat edges;
        cv::Canny(smooth, edges, strong / 2, strong, 3, true);
        cv::dilate(edges, edges, cv::Mat::ones(3, 3, CV_8U));  // closes gaps of a pixel or two
        std::vector<std::vector<cv::Point>> contours;
        cv::findContours(edges, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
        for (const auto& contour : contours)
            if (const auto quad = asQuad(contour, grey.size(), m_options)) all.push_back(*quad);
    }
    std::sort(all.begin(), all.end(), before);
    std::vector<TQuad> result;
    for (const auto& quad : all)
        if (std::none_of(result.begin(), result.end(),
                         [&](const TQuad& kept) { return same(kept, quad); }))
            result.push_back(quad);
    return result;
}

}  // namespace salma::saliency
