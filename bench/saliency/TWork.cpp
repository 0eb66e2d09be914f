// SPDX-License-Identifier: BSD-3-Clause
#include "TWork.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace salma::bench {
namespace {

using saliency::TScaleSaliencyOptions;

// As libs/saliency/src/TScaleTables.h has them.
constexpr int kTileRows = 64;
constexpr int kBandRows = 8;
constexpr int kColumns = 64;
constexpr int kPart = 32;

/// Of all ring pixels of a row dy.
struct TRow {
    double pixels{0};
    double fullAdders{0};
    double halfAdders{0};
};

class CWork {
 public:
    CWork(const cv::Mat& grey, const TScaleSaliencyOptions& options)
        : m_options(options),
          m_reach(options.scaleMax),
          m_scales(options.scaleMax - options.scaleMin + 1),
          m_occurs(static_cast<std::size_t>(options.bins)),
          m_firstScale(m_occurs.size()) {
        listRows();
        for (std::size_t b = 0; b < m_occurs.size(); ++b) mapBin(grey, static_cast<int>(b));
    }

    void addTile(const cv::Rect& centres) {
        const cv::Rect window(centres.x - m_reach, centres.y - m_reach, centres.width + 2 * m_reach,
                              centres.height + 2 * m_reach);
        for (const auto& bin : m_occurs)
            if (cv::countNonZero(bin(window)) > 0) ++m_work.tileBins;
        for (int y = centres.y; y < centres.br().y; y += kBandRows)
            addBand({centres.x, y, centres.width, std::min(kBandRows, centres.br().y - y)});
        m_work.centres += centres.area();
    }

    const TWork& work() const { return m_work; }

 private:
    void listRows() {
        std::vector<int> area;
        for (int s = 0; s <= m_reach; ++s) {
            area.push_back(0);
            for (int j = -s; j <= s; ++j) area.back() += 2 * int(std::sqrt(s * s - j * j)) + 1;
        }
        for (int dy = -m_reach; dy <= m_reach; ++dy) {
            TRow row;
            for (int dx = -m_reach; dx <= m_reach; ++dx) {
                const int s = std::max(m_options.scaleMin, int(std::ceil(std::hypot(dx, dy))));
                if (s > m_reach) continue;
                const auto i = static_cast<std::size_t>(s);
                const int most = s == m_options.scaleMin ? area[i] : area[i] - area[i - 1];
                const int planes = most < 64 ? 6 : most < 128 ? 7 : 8;
                row.pixels += 1;
                row.fullAdders += 15.0 / 16;  // 8 + 4 + 2 + 1 for sixteen pixels
                row.halfAdders += (planes - 4) / 16.0;
            }
            m_rows.push_back(row);
        }
    }

    /// Where a bin occurs, and from which scale on it is within the disc.
    void mapBin(const cv::Mat& grey, int bin) {
        cv::Mat1b others(grey.size());
        for (int y = 0; y < grey.rows; ++y)
            for (int x = 0; x < grey.cols; ++x)
                others(y, x) =
                    std::lround(grey.at<std::uint8_t>(y, x) * (m_options.bins - 1) / 255.0) != bin;
        const auto b = static_cast<std::size_t>(bin);
        m_occurs[b] = 1 - others;
        if (cv::countNonZero(m_occurs[b]) > 0)
            cv::distanceTransform(others, m_firstScale[b], cv::DIST_L2, cv::DIST_MASK_PRECISE);
        else
            m_firstScale[b] = cv::Mat1f(grey.size(), 1e6F);
    }

    void addBand(const cv::Rect& centres) {
        const cv::Rect window(centres.x - m_reach, centres.y - m_reach, centres.width + 2 * m_reach,
                              centres.height + 2 * m_reach);
        std::vector<cv::Range> rows;  // of the bins that occur
        std::vector<int> pixels;
        for (const auto& bin : m_occurs) {
            std::vector<cv::Point> places;
            cv::findNonZero(bin(window), places);  // by row
            if (places.empty()) continue;
            rows.emplace_back(places.front().y, places.back().y + 1);
            pixels.push_back(static_cast<int>(places.size()));
        }
        if (rows.size() < 2) return;
        const auto most = std::max_element(pixels.begin(), pixels.end()) - pixels.begin();
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (static_cast<std::ptrdiff_t>(i) != most) addBin(rows[i]);
        m_work.bandBins += static_cast<double>(rows.size());
        m_work.bands += 1;
        for (int y = centres.y; y < centres.br().y; ++y)
            for (int x = centres.x; x < centres.br().x; x += kPart)
                addPart({x, y, std::min(kPart, centres.br().x - x), 1});
    }

    void addBin(const cv::Range& rows) {
        const int last = std::min(rows.end, static_cast<int>(m_rows.size()));
        for (int i = std::max(rows.start - kBandRows + 1, 0); i < last; ++i) {
            const TRow& row = m_rows[static_cast<std::size_t>(i)];
            m_work.ringPixels += row.pixels;
            m_work.fullAdders += row.fullAdders;
            m_work.halfAdders += row.halfAdders;
        }
        m_work.rings += m_scales;
    }

    void addPart(const cv::Rect& part) {
        for (const auto& distance : m_firstScale) {
            double nearest = 0;
            cv::minMaxLoc(distance(part), &nearest);
            const int first = std::max(m_options.scaleMin, int(std::ceil(nearest - 1e-3)));
            m_work.sums += std::max(0, m_reach - first + 1);
        }
        m_work.partScales += m_scales;
    }

    TScaleSaliencyOptions m_options;
    int m_reach;
    int m_scales;
    std::vector<cv::Mat1b> m_occurs;      // by bin
    std::vector<cv::Mat1f> m_firstScale;  // by bin
    std::vector<TRow> m_rows;
    TWork m_work;
};

}  // namespace

TWork workFor(const cv::Mat& grey, const TScaleSaliencyOptions& options) {
    CWork work(grey, options);
    const int reach = options.scaleMax;
    const cv::Rect centres(reach, reach, grey.cols - 2 * reach, grey.rows - 2 * reach);
    for (int y = centres.y; y < centres.br().y; y += kTileRows)
        for (int x = centres.x; x < centres.br().x; x += kColumns)
            work.addTile(cv::Rect(x, y, kColumns, kTileRows) & centres);
    return work.work();
}

TBound boundOf(const TWork& work, const TScaleSaliencyOptions& options, const TThroughput& speed) {
    // Operations of one instruction where AVX-512 has ternary logic, of several elsewhere; and of
    // multiply-adds where there is only multiplication and addition.
    const bool ternary = speed.bits == 512;
    const bool fused = speed.simd != saliency::ESimd::sse4;
    const double fullAdder = ternary ? 2 : 5;
    const double swap = ternary ? 5 : 6;
    const double logarithm = (ternary ? 4 : 5) + (fused ? 7 : 14);
    const double perBand = 512.0 / speed.bits;        // vectors of one bit for 8 x 64 centres
    const double shorts = kPart * 16.0 / speed.bits;  // vectors for a part
    const double blocks = speed.bits / 128.0;         // that joined bytes are stored in
    const double cycles = 1 / (speed.operations * work.centres);
    const double windowRows = kTileRows + 2 * options.scaleMax;
    const double window = (2 * options.scaleMax + 1) * windowRows * 64 / speed.bits;
    TBound bound;
    bound.bitmaps = work.tileBins * window * 4 * cycles;  // three shifts and an or
    const double adders = work.fullAdders * fullAdder + work.halfAdders * 2;
    bound.counting =
        perBand * std::max(adders * cycles, work.ringPixels / (speed.loads * work.centres));
    // Twelve swaps of bits, 24 interleavings, and what takes the upper blocks out of vectors; or 24
    // shuffles, and a permutation and an affine map for each row.
    const double join =
        speed.simd == saliency::ESimd::avx512dl ? 24 + 8 * 2 : 12 * swap + 24 + 8 * (blocks - 1);
    bound.joining = work.rings * perBand * join * cycles;
    const double scales = options.scaleMax - options.scaleMin + 1;
    bound.rest = (work.bandBins - work.bands) * scales * 8 * perBand * cycles;
    // To words, add, two zips; then twice multiply in pairs, maximum, add, and a logarithm. In it
    // are two conversions, seven multiply-adds.
    const double ofSum = 4 + 2 * (3 + logarithm);
    const double multiplications = 2 * (1 + 2 + 7);
    bound.sums = work.sums * shorts / work.centres *
                 std::max(ofSum / speed.operations, multiplications / speed.multiplyAdds);
    // W in doubles: six operations; marks: ten on floats; two products for entropies.
    bound.peaks = work.partScales * shorts * (4 * 6 + 2 * 10 + 2) * cycles;
    return bound;
}

}  // namespace salma::bench
