// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/CScaleSaliency.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <future>
#include <mutex>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <queue>
#include <stdexcept>
#include <string>

#include "CSaliencyTile.h"
#include "binTable.h"
#include "simdTargets.h"

namespace salma::saliency {

using TRegions = std::vector<observations::TSalientRegion>;

namespace {

/// The threshold, which rises as soon as as many peaks as are wanted are known to pass it.
class CThreshold {
 public:
    explicit CThreshold(const TPeakLimits& limits) : m_yMin(limits.yMin), m_best(limits.best) {}

    double yMin() const { return m_yMin; }

    void add(const std::vector<TPeak>& peaks) {
        if (m_best == 0) return;
        const std::lock_guard<std::mutex> lock(m_mutex);
        for (const TPeak& peak : peaks) {
            const double y = peak.H * peak.W;
            if (m_largest.size() == m_best && !(y > m_largest.top())) continue;
            m_largest.push(y);
            if (m_largest.size() > m_best) m_largest.pop();
        }
        if (m_largest.size() == m_best) m_yMin = std::max<double>(m_yMin, m_largest.top());
    }

 private:
    std::atomic<double> m_yMin;
    std::size_t m_best;
    std::mutex m_mutex;
    std::priority_queue<double, std::vector<double>, std::greater<>> m_largest;
};

/** The tiles of a picture, handed out to threads, and the peaks that come back. Whoever completes
 * a row of tiles puts its peaks in order while others go on. */
class CTiles {
 public:
    struct TTile {
        cv::Rect centres;
        std::size_t row{0};  //!< Of tiles.
        TTilePeaks found;
    };

    explicit CTiles(const cv::Rect& centres) {
        for (int y = centres.y; y < centres.br().y; y += kTileRows) {
            for (int x = centres.x; x < centres.br().x; x += kLanes)
                m_tiles.push_back({cv::Rect(x, y, kLanes, kTileRows) & centres, m_ends.size(), {}});
            m_ends.push_back(m_tiles.size());
        }
        m_left = std::vector<std::atomic<std::size_t>>(m_ends.size());
        for (std::size_t row = 0; row < m_left.size(); ++row)
            m_left[row] = m_ends[row] - firstOf(row);
    }

    std::size_t size() const { return m_tiles.size(); }

    /// A tile that nobody has had yet, or null.
    TTile* next() {
        const std::size_t i = m_taken++;
        return i < m_tiles.size() ? &m_tiles[i] : nullptr;
    }

    /// The peaks of a tile are found.
    void complete(const TTile& tile) {
        if (--m_left[tile.row] > 0) return;
        const std::unique_lock<std::mutex> lock(m_joining, std::try_to_lock);
        if (lock.owns_lock()) joinComplete();  // else who joins now, or takeAll, will find it
    }

    /// By row, column, scale; once all tiles are complete and no thread is left.
    TRegions takeAll() {
        joinComplete();
        return std::move(m_all);
    }

 private:
    std::size_t firstOf(std::size_t row) const { return row == 0 ? 0 : m_ends[row - 1]; }

    void joinComplete() {
        for (; m_joined < m_left.size() && m_left[m_joined] == 0; ++m_joined) join(m_joined);
    }

    void join(std::size_t row) {
        std::size_t count = m_all.size();
        for (std::size_t i = firstOf(row); i < m_ends[row]; ++i)
            count += m_tiles[i].found.peaks.size();
        if (count > m_all.capacity())  // as if the rows to come had as many
            m_all.reserve(count + count / (row + 1) * (m_left.size() - row - 1) * 11 / 10);
        const cv::Rect tile = m_tiles[firstOf(row)].centres;
        for (std::size_t r = 0; r < static_cast<std::size_t>(tile.height); ++r)
            for (std::size_t i = firstOf(row); i < m_ends[row]; ++i) {
                const auto& found = m_tiles[i].found;
                for (std::size_t p = r == 0 ? 0 : found.ends[r - 1]; p < found.ends[r]; ++p) {
                    const TPeak& peak = found.peaks[p];
                    m_all.push_back({double(peak.column), double(tile.y) + double(r),
                                     double(peak.scale), peak.H, peak.W, peak.H * peak.W});
                }
            }
        for (std::size_t i = firstOf(row); i < m_ends[row]; ++i) m_tiles[i].found = {};
    }

    std::vector<TTile> m_tiles;
    std::vector<std::size_t> m_ends;               //!< Of each row of tiles, in m_tiles.
    std::vector<std::atomic<std::size_t>> m_left;  //!< Tiles of a row that are not complete.
    std::atomic<std::size_t> m_taken{0};
    std::mutex m_joining;
    std::size_t m_joined{0};  //!< Rows that are in m_all.
    TRegions m_all;
};

/// Leaves the `best` of largest Y, of equal ones the first, in their order.
void keepBest(std::size_t best, TRegions& regions) {
    if (best == 0 || regions.size() <= best) return;
    std::vector<std::size_t> order(regions.size());
    std::iota(order.begin(), order.end(), 0);
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(best);
    std::nth_element(order.begin(), end, order.end(), [&regions](std::size_t a, std::size_t b) {
        return std::make_pair(-regions[a].Y, a) < std::make_pair(-regions[b].Y, b);
    });
    std::sort(order.begin(), end);
    TRegions kept;
    kept.reserve(best);
    for (auto i = order.begin(); i != end; ++i) kept.push_back(regions[*i]);
    regions.swap(kept);
}

template <class COUNT>
void work(const TScaleTables& tables,
          const cv::Mat& bins,
          ESimd simd,
          CThreshold& threshold,
          CTiles& tiles) {
    CSaliencyTile<COUNT> detector(tables, simd);
    for (auto* tile = tiles.next(); tile != nullptr; tile = tiles.next()) {
        tile->found = detector.detect(bins, tile->centres, threshold.yMin());
        threshold.add(tile->found.peaks);
        tiles.complete(*tile);
    }
}

std::string typeName(const cv::Mat& picture) {
    static constexpr const char* kDepths[] = {"8U", "8S", "16U", "16S", "32S", "32F", "64F", "16F"};
    return std::string("CV_") + kDepths[picture.depth()] + "C" + std::to_string(picture.channels());
}

/// \throw std::invalid_argument if the picture is of a type that is not known.
cv::Mat greyOf(const cv::Mat& picture) {
    cv::Mat grey = picture;
    if (picture.empty()) return grey;
    if (picture.type() == CV_8UC3)
        cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    else if (picture.type() == CV_8UC4)
        cv::cvtColor(picture, grey, cv::COLOR_BGRA2GRAY);
    else if (picture.type() != CV_8UC1)
        throw std::invalid_argument(
            "scale saliency needs a picture of 8 bits (CV_8UC1, CV_8UC3 or CV_8UC4), got " +
            typeName(picture));
    return grey;
}

}  // namespace

void TScaleSaliencyOptions::visit(config::COptionVisitor& v) {
    v.integer("scale_min_px", scaleMin, config::between(1, 126), "smallest radius of a disc");
    v.integer("scale_max_px", scaleMax, config::between(3, 128), "largest radius of a disc");
    v.integer("bins", bins, config::between(2, 256), "cells of the histogram of the grey level");
    v.choice("log_base", logBase, {{"natural", ELogBase::natural}, {"2", ELogBase::two}},
             "logarithm of the entropy");
    v.flag("smooth", smooth, "smooth the inter-scale saliency over three scales");
    v.flag("stretch", stretch, "stretch the grey levels of a picture to the full range first");
    v.integer("threads", threads, config::between(1, 256),
              "threads; they do not change the result");
    v.choice("simd", simd,
             {{"auto", ESimd::automatic},
              {"portable", ESimd::portable},
              {"sse4", ESimd::sse4},
              {"avx2", ESimd::avx2},
              {"avx512", ESimd::avx512},
              {"avx512dl", ESimd::avx512dl},
              {"neon", ESimd::neon}},
             "instruction set; it does not change the result");
}

void TScaleSaliencyOptions::validate() const {
    checkRanges();
    if (scaleMax < scaleMin + 2)
        throw std::invalid_argument(
            "scale_max_px = " + std::to_string(scaleMax) +
            " must be at least scale_min_px + 2 = " + std::to_string(scaleMin + 2));
}

CScaleSaliency::CScaleSaliency(const TScaleSaliencyOptions& options) : m_options(options) {
    m_options.validate();
    static_cast<void>(availableSimd(options.simd));  // throws if it is not
    m_tables = std::make_shared<const TScaleTables>(m_options);
}

TRegions CScaleSaliency::detect(const cv::Mat& picture, const TPeakLimits& limits) const {
    if (std::isnan(limits.yMin))
        throw std::invalid_argument("scale saliency: y_min is not a number");
    const int reach = m_options.scaleMax;
    const bool tooSmall = std::min(picture.rows, picture.cols) <= 2 * reach;
    const cv::Mat grey = greyOf(picture);
    if (tooSmall) return {};
    cv::Mat bins;
    cv::LUT(grey, binTable(grey, m_options), bins);
    cv::Rect centres(reach, reach, grey.cols - 2 * reach, grey.rows - 2 * reach);
    if (!limits.centres.empty()) centres &= limits.centres;
    CTiles tiles(centres);
    CThreshold threshold(limits);
    const auto worker = [&] {
        const auto run = m_tables->fitsBytes() ? work<std::uint8_t> : work<std::uint16_t>;
        run(*m_tables, bins, m_options.simd, threshold, tiles);
    };
    std::vector<std::future<void>> others;
    for (int i = 1; i < m_options.threads && static_cast<std::size_t>(i) < tiles.size(); ++i)
        others.push_back(std::async(std::launch::async, worker));
    worker();
    for (auto& other : others) other.get();
    auto regions = tiles.takeAll();
    keepBest(limits.best, regions);
    return regions;
}

}  // namespace salma::saliency
