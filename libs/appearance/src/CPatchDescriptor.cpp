// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/CPatchDescriptor.h>

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <stdexcept>
#include <tuple>

namespace salma::appearance {
namespace {

constexpr int kSmallest = 8;      // smaller pictures hold no extremum of any scale [px]
constexpr std::size_t kFew = 12;  // keypoints; with fewer, a dim patch is looked at once more
constexpr double kDim = 30;       // standard deviation below which a patch is dim [grey levels]
constexpr double kNoise = 5;      // and below which it holds little but noise [grey levels]

/// A dim picture brought to kDim; empty for others.
cv::Mat brightened(const cv::Mat& grey) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(grey, mean, deviation);
    if (!(deviation[0] >= kNoise && deviation[0] < kDim)) return {};
    const double gain = kDim / deviation[0];
    cv::Mat out;
    grey.convertTo(out, -1, gain, 127.5 - gain * mean[0]);
    return out;
}

std::vector<cv::KeyPoint> strongest(std::vector<cv::KeyPoint> points, int limit) {
    const auto order = [](const cv::KeyPoint& p) {
        return std::make_tuple(-p.response, p.pt.y, p.pt.x, p.size, p.angle);
    };
    std::sort(points.begin(), points.end(),
              [&](const auto& a, const auto& b) { return order(a) < order(b); });
    if (points.size() > static_cast<std::size_t>(limit)) points.resize(limit);
    return points;
}

observations::TKeypoint asKeypoint(const cv::KeyPoint& p,
                                   const cv::Mat& descriptor,
                                   const cv::Size& size,
                                   double pixelsPerMetre) {
    observations::TKeypoint out;
    out.x = (p.pt.x - (size.width - 1) / 2.0) / pixelsPerMetre;
    out.y = ((size.height - 1) / 2.0 - p.pt.y) / pixelsPerMetre;
    out.scale = p.size / pixelsPerMetre;
    out.angle = mrpt::math::wrapToPi(-p.angle * M_PI / 180);  // OpenCV's runs clockwise
    for (std::size_t i = 0; i < out.descriptor.size(); ++i)
        out.descriptor[i] =
            cv::saturate_cast<std::uint8_t>(descriptor.at<float>(static_cast<int>(i)));
    return out;
}

}  // namespace

void TDescriptorOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.integer("max_keypoints", maxKeypoints, between(1, 5000), "the strongest are kept");
    v.number("contrast_threshold", contrastThreshold, atLeast(0), "weaker extrema are dropped");
    v.number("edge_threshold", edgeThreshold, moreThan(1), "more elongated extrema are dropped");
    v.number("sigma_px", sigma, moreThan(0.5), "blur of the first layer");
}

CPatchDescriptor::CPatchDescriptor(const TDescriptorOptions& options) : m_options(options) {
    m_options.validate();
}

std::vector<observations::TKeypoint> CPatchDescriptor::describe(
    const observations::TPatch& patch) const {
    if (patch.picture.isEmpty()) return {};
    const cv::Mat grey = patch.picture.asCvMatRef();
    auto keypoints = describe(grey, patch.pixelsPerMetre);
    if (keypoints.size() >= kFew) return keypoints;
    const cv::Mat bright = brightened(grey);
    return bright.empty() ? keypoints : describe(bright, patch.pixelsPerMetre);
}

std::vector<observations::TKeypoint> CPatchDescriptor::describe(const cv::Mat& grey,
                                                                double pixelsPerMetre) const {
    if (grey.empty() || std::min(grey.rows, grey.cols) < kSmallest) return {};
    if (grey.type() != CV_8UC1)
        throw std::invalid_argument("description needs a grey picture of 8 bits");
    if (!(pixelsPerMetre > 0))
        throw std::invalid_argument("description needs a positive number of pixels per metre");
    const auto sift = cv::SIFT::create(0, 3, m_options.contrastThreshold, m_options.edgeThreshold,
                                       m_options.sigma);
    std::vector<cv::KeyPoint> points;
    sift->detect(grey, points);
    points = strongest(std::move(points), m_options.maxKeypoints);
    cv::Mat descriptors;
    if (!points.empty()) sift->compute(grey, points, descriptors);
    std::vector<observations::TKeypoint> out;
    for (std::size_t i = 0; i < points.size(); ++i)
        out.push_back(asKeypoint(points[i], descriptors.row(static_cast<int>(i)), grey.size(),
                                 pixelsPerMetre));
    return out;
}

}  // namespace salma::appearance
