// SPDX-License-Identifier: BSD-3-Clause
#include "referenceScaleSaliency.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace salma::saliency::test {
namespace {

cv::Mat binsOf(const cv::Mat& grey, const TScaleSaliencyOptions& options) {
    double low = 0;
    double high = 255;
    if (options.stretch) cv::minMaxLoc(grey, &low, &high);
    cv::Mat bins(grey.size(), CV_32S, cv::Scalar(0));
    for (int y = 0; y < grey.rows && high > low; ++y)
        for (int x = 0; x < grey.cols; ++x) {
            const double stretched = (grey.at<std::uint8_t>(y, x) - low) / (high - low);
            bins.at<int>(y, x) = static_cast<int>(std::lround(stretched * (options.bins - 1)));
        }
    return bins;
}

/// Proportions of the bins in the disc of radius s about (cx, cy).
std::vector<double> proportions(const cv::Mat& bins, int cx, int cy, int s, int count) {
    std::vector<double> p(static_cast<std::size_t>(count), 0.0);
    double pixels = 0;
    for (int j = -s; j <= s; ++j)
        for (int i = -s; i <= s; ++i) {
            if (i * i + j * j > s * s) continue;
            p[static_cast<std::size_t>(bins.at<int>(cy + j, cx + i))] += 1;
            pixels += 1;
        }
    for (double& value : p) value /= pixels;
    return p;
}

double entropy(const std::vector<double>& p, ELogBase base) {
    double sum = 0;
    for (const double value : p)
        if (value > 0) sum -= value * std::log(value);
    return base == ELogBase::two ? sum / std::log(2) : sum;
}

}  // namespace

std::vector<observations::TSalientRegion> referenceScaleSaliency(
    const cv::Mat& grey, const TScaleSaliencyOptions& options) {
    std::vector<observations::TSalientRegion> peaks;
    const int reach = options.scaleMax;
    const auto last = static_cast<std::size_t>(reach - options.scaleMin);
    const cv::Mat bins = binsOf(grey, options);
    for (int y = reach; y < grey.rows - reach; ++y)
        for (int x = reach; x < grey.cols - reach; ++x) {
            std::vector<double> h;
            std::vector<double> d{0};
            std::vector<double> before;
            for (int s = options.scaleMin; s <= reach; ++s) {
                const auto p = proportions(bins, x, y, s, options.bins);
                h.push_back(entropy(p, options.logBase));
                double change = 0;
                for (std::size_t b = 0; b < before.size(); ++b)
                    change += std::abs(p[b] - before[b]);
                if (!before.empty()) d.push_back(change);
                before = p;
            }
            d[0] = d[1];
            for (std::size_t k = 1; options.smooth && k < last; ++k)
                d[k] = (d[k - 1] + d[k] + d[k + 1]) / 3;
            for (std::size_t k = 1; k < last; ++k) {
                if (!(h[k] - h[k - 1] > 1e-11 && h[k] - h[k + 1] > 1e-11)) continue;
                const double s = options.scaleMin + static_cast<double>(k);
                const double w = s * s / (2 * s - 1) * d[k];
                peaks.push_back({double(x), double(y), s, h[k], w, h[k] * w});
            }
        }
    return peaks;
}

}  // namespace salma::saliency::test
