// SPDX-License-Identifier: BSD-3-Clause
#include "CStripHistograms.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace salma::landmarks {
namespace {

constexpr int kPieces = 3;  // of each side
constexpr int kFewest = 8;  // pixels of a strip that say something
constexpr int kGap = 1;     // pixels beside the edge are a mixture of both sides

}  // namespace

CStripHistograms::CStripHistograms(const cv::Mat& wall, const cv::Mat& valid)
    : m_size(wall.size()) {
    double low = 0, high = 0;
    cv::minMaxLoc(wall, &low, &high, nullptr, nullptr, valid);
    const double width = std::max(1.0, (high - low + 1) / kBins);
    for (int bin = 0; bin < kBins; ++bin) {
        cv::Mat inBin;
        cv::inRange(wall, cv::Scalar(std::ceil(low + bin * width)),
                    cv::Scalar(std::ceil(low + (bin + 1) * width) - 1), inBin);
        inBin = inBin & valid & 1;
        m_sums.emplace_back();
        cv::integral(inBin, m_sums.back(), CV_32S);
    }
}

CStripHistograms::Histogram CStripHistograms::histogram(const cv::Rect& area) const {
    Histogram h{};
    const cv::Rect r = area & cv::Rect({0, 0}, m_size);
    if (r.empty()) return h;
    for (std::size_t bin = 0; bin < h.size(); ++bin) {
        const auto& s = m_sums[bin];
        h[bin] = static_cast<float>(s.at<int>(r.br()) - s.at<int>(r.y, r.br().x) -
                                    s.at<int>(r.br().y, r.x) + s.at<int>(r.tl()));
    }
    return h;
}

/// Hellinger distance in [0, 1]; 0 where too little is known.
double CStripHistograms::distance(const cv::Rect& inside, const cv::Rect& outside) const {
    const Histogram a = histogram(inside), b = histogram(outside);
    double n = 0, m = 0, common = 0;
    for (std::size_t bin = 0; bin < a.size(); ++bin) {
        n += a[bin];
        m += b[bin];
        common += std::sqrt(a[bin] * b[bin]);
    }
    if (!(std::min(n, m) >= kFewest)) return 0;
    return std::sqrt(std::max(0.0, 1 - common / std::sqrt(n * m)));
}

double CStripHistograms::separation(const cv::Rect& r, const cv::Size& strip, double least) const {
    const int dx = std::clamp(strip.width, 1, std::max(1, r.width / 3));
    const int dy = std::clamp(strip.height, 1, std::max(1, r.height / 3));
    double sum = 0;
    const auto add = [&](const cv::Rect& inside, const cv::Rect& outside) {
        sum += std::clamp(distance(inside, outside) / least - 1, 0.0, 1.0);
    };
    for (int k = 0; k < kPieces; ++k) {
        const int x = r.x + k * r.width / kPieces, w = r.x + (k + 1) * r.width / kPieces - x;
        const int y = r.y + k * r.height / kPieces, h = r.y + (k + 1) * r.height / kPieces - y;
        add({r.x + kGap, y, dx, h}, {r.x - kGap - dx, y, dx, h});
        add({r.br().x - kGap - dx, y, dx, h}, {r.br().x + kGap, y, dx, h});
        add({x, r.y + kGap, w, dy}, {x, r.y - kGap - dy, w, dy});
        add({x, r.br().y - kGap - dy, w, dy}, {x, r.br().y + kGap, w, dy});
    }
    return sum / (4 * kPieces);
}

}  // namespace salma::landmarks
