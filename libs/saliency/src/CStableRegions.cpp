// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/CStableRegions.h>

#include <algorithm>
#include <iterator>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <tuple>

namespace salma::saliency {
namespace {

bool before(const cv::Point& a, const cv::Point& b) {
    return std::make_tuple(a.y, a.x) < std::make_tuple(b.y, b.x);
}

/// Ellipse of the pixels, each a square of its own moments (1/12), so that a line of pixels has
/// one.
TEllipse ellipseOfPixels(const std::vector<cv::Point>& pixels) {
    const auto n = static_cast<double>(pixels.size());
    double u = 0;
    double v = 0;
    for (const auto& p : pixels) {
        u += p.x / n;
        v += p.y / n;
    }
    double moments[3] = {1.0 / 12, 0, 1.0 / 12};
    for (const auto& p : pixels) {
        moments[0] += (p.x - u) * (p.x - u) / n;
        moments[1] += (p.x - u) * (p.y - v) / n;
        moments[2] += (p.y - v) * (p.y - v) / n;
    }
    return ellipseOfMoments(u, v, moments);
}

/// The same pixels by row, then column: painted into their box and read back, which takes a
/// fraction of the time of sorting them.
std::vector<cv::Point> inOrder(const std::vector<cv::Point>& pixels, const cv::Rect& box) {
    cv::Mat inside(box.size(), CV_8UC1, cv::Scalar(0));
    for (const auto& p : pixels) inside.at<std::uint8_t>(p - box.tl()) = 1;
    std::vector<cv::Point> ordered;
    cv::findNonZero(inside, ordered);
    for (auto& p : ordered) p += box.tl();
    return ordered;
}

TStableRegion describe(const cv::Mat& grey,
                       const std::vector<cv::Point>& pixels,
                       EPolarity polarity) {
    TStableRegion region;
    region.box = cv::boundingRect(pixels);
    region.pixels = inOrder(pixels, region.box);
    region.ellipse = ellipseOfPixels(region.pixels);
    double sum = 0;
    for (const auto& p : region.pixels) sum += grey.at<std::uint8_t>(p);
    region.meanGrey = sum / static_cast<double>(region.pixels.size());
    region.polarity = polarity;
    return region;
}

}  // namespace

void TStableRegionsOptions::visit(config::COptionVisitor& v) {
    v.integer("delta", delta, config::between(1, 254), "grey levels over which areas are compared");
    v.integer("min_area_px2", minArea, config::atLeast(1), "smallest area of a region");
    v.number("max_area_fraction", maxAreaFraction, {0, 1, true, false},
             "largest area of a region, as a fraction of the picture");
    v.number("max_variation", maxVariation, config::moreThan(0),
             "largest relative change of the area");
    v.number("min_diversity", minDiversity, config::between(0, 1),
             "smallest relative difference of the area to an enclosing region");
}

CStableRegions::CStableRegions(const TStableRegionsOptions& options) : m_options(options) {
    m_options.validate();
}

std::vector<TStableRegion> CStableRegions::detect(const cv::Mat& grey) const {
    if (grey.type() != CV_8UC1)
        throw std::invalid_argument("stable regions need a grey picture of 8 bits (CV_8UC1)");
    if (std::min(grey.rows, grey.cols) < 3) return {};  // OpenCV refuses these
    const auto maxArea =
        static_cast<int>(m_options.maxAreaFraction * static_cast<double>(grey.total()));
    const auto mser = cv::MSER::create(m_options.delta, m_options.minArea, maxArea,
                                       m_options.maxVariation, m_options.minDiversity);
    // OpenCV does not tell the polarity, but can be asked for its second pass alone: bright ones.
    mser->setPass2Only(true);
    cv::Mat negative;
    cv::bitwise_not(grey, negative);
    std::vector<TStableRegion> regions;
    for (const EPolarity polarity : {EPolarity::darkOnBright, EPolarity::brightOnDark}) {
        std::vector<std::vector<cv::Point>> pixels;
        std::vector<cv::Rect> boxes;
        mser->detectRegions(polarity == EPolarity::darkOnBright ? negative : grey, pixels, boxes);
        const auto first = static_cast<std::ptrdiff_t>(regions.size());
        for (const auto& p : pixels) regions.push_back(describe(grey, p, polarity));
        std::sort(regions.begin() + first, regions.end(), [](const auto& a, const auto& b) {
            return a.pixels[0] != b.pixels[0] ? before(a.pixels[0], b.pixels[0])
                                              : a.pixels.size() < b.pixels.size();
        });
    }
    return regions;
}

}  // namespace salma::saliency
