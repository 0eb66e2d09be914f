// SPDX-License-Identifier: BSD-3-Clause
#include "plainScaleSaliency.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace salma::saliency::test {
namespace {

using TRegions = std::vector<observations::TSalientRegion>;

class CPlain {
 public:
    CPlain(const cv::Mat& grey, const TScaleSaliencyOptions& options)
        : m_options(options),
          m_bins(grey.size(), CV_32S),
          m_scales(static_cast<std::size_t>(options.scaleMax - options.scaleMin) + 1),
          m_rings(m_scales),
          m_h(m_scales),
          m_d(m_scales) {
        quantise(grey);
        const int reach = options.scaleMax;
        for (int j = -reach; j <= reach; ++j)
            for (int i = -reach; i <= reach; ++i)
                for (int s = options.scaleMin; s <= reach; ++s)
                    if (i * i + j * j <= s * s) {
                        m_rings[static_cast<std::size_t>(s - options.scaleMin)].emplace_back(i, j);
                        break;
                    }
        std::size_t pixels = 0;
        for (const auto& ring : m_rings) pixels += ring.size();
        for (std::size_t n = 0; n <= pixels; ++n) {
            const auto x = static_cast<double>(n);
            const bool two = options.logBase == ELogBase::two;
            m_nLogN.push_back(n < 2 ? 0 : x * (two ? std::log2(x) : std::log(x)));
        }
    }

    void findPeaks(int x, int y, TRegions& peaks) {
        std::vector<int> counts(static_cast<std::size_t>(m_options.bins), 0);
        int area = 0;
        for (std::size_t k = 0; k < m_scales; ++k) {
            const auto before = counts;
            const int areaBefore = area;
            for (const auto& [i, j] : m_rings[k])
                ++counts[static_cast<std::size_t>(m_bins.at<int>(y + j, x + i))];
            area += static_cast<int>(m_rings[k].size());
            m_h[k] = entropy(counts, area);
            m_d[k] = k == 0 ? 0 : change(before, areaBefore, counts, area);
        }
        smooth();
        for (std::size_t k = 1; k + 1 < m_scales; ++k) {
            if (!(m_h[k] - m_h[k - 1] > 1e-11 && m_h[k] - m_h[k + 1] > 1e-11)) continue;
            const int s = m_options.scaleMin + static_cast<int>(k);
            const double w = m_d[k] * (double(s * s) / double(2 * s - 1));
            peaks.push_back({double(x), double(y), double(s), m_h[k], w, m_h[k] * w});
        }
    }

 private:
    void quantise(const cv::Mat& grey) {
        double low = 0;
        double high = 255;
        if (m_options.stretch) cv::minMaxLoc(grey, &low, &high);
        const double range = std::max(high - low, 1.0);
        for (int y = 0; y < grey.rows; ++y)
            for (int x = 0; x < grey.cols; ++x)
                m_bins.at<int>(y, x) = static_cast<int>(std::lround(
                    (grey.at<std::uint8_t>(y, x) - low) * (m_options.bins - 1) / range));
    }

    double entropy(const std::vector<int>& counts, int area) const {
        double sum = 0;
        for (const int n : counts) sum += m_nLogN[static_cast<std::size_t>(n)];
        return (m_nLogN[static_cast<std::size_t>(area)] - sum) / area;
    }

    static double change(const std::vector<int>& before,
                         int areaBefore,
                         const std::vector<int>& counts,
                         int area) {
        std::int64_t sum = 0;
        for (std::size_t b = 0; b < counts.size(); ++b)
            sum += std::max<std::int64_t>(
                0, std::int64_t{counts[b]} * areaBefore - std::int64_t{before[b]} * area);
        return static_cast<double>(sum) * (2 / (double(area) * areaBefore));
    }

    void smooth() {
        m_d[0] = m_d[1];
        for (std::size_t k = 1; m_options.smooth && k + 1 < m_scales; ++k)
            m_d[k] = (m_d[k - 1] + (m_d[k] + m_d[k + 1])) * (1.0 / 3.0);
    }

    TScaleSaliencyOptions m_options;
    cv::Mat m_bins;
    std::size_t m_scales;
    std::vector<std::vector<std::pair<int, int>>> m_rings;
    std::vector<double> m_nLogN;
    std::vector<double> m_h;
    std::vector<double> m_d;
};

}  // namespace

TRegions plainScaleSaliency(const cv::Mat& grey, const TScaleSaliencyOptions& options) {
    TRegions peaks;
    const int reach = options.scaleMax;
    if (std::min(grey.rows, grey.cols) <= 2 * reach) return peaks;
    CPlain plain(grey, options);
    for (int y = reach; y < grey.rows - reach; ++y)
        for (int x = reach; x < grey.cols - reach; ++x) plain.findPeaks(x, y, peaks);
    return peaks;
}

}  // namespace salma::saliency::test
