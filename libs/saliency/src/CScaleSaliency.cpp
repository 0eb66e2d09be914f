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

/// A tile's centres and their peaks.
struct TJob {
    cv::Rect centres;
    TTilePeaks found;
};

/// The tiles of a picture, row by row of tiles.
std::vector<TJob> cut(const cv::Rect& centres) {
    std::vector<TJob> jobs;
    for (int y = centres.y; y < centres.br().y; y += kTileRows)
        for (int x = centres.x; x < centres.br().x; x += kLanes)
            jobs.push_back({cv::Rect(x, y, kLanes, kTileRows) & centres, {}});
    return jobs;
}

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

/// The peaks of all tiles by row, column, scale.
TRegions join(const std::vector<TJob>& jobs) {
    std::size_t count = 0;
    for (const auto& job : jobs) count += job.found.peaks.size();
    TRegions all;
    all.reserve(count);
    for (std::size_t first = 0, last = 0; first < jobs.size(); first = last) {
        const cv::Rect& tile = jobs[first].centres;
        while (last < jobs.size() && jobs[last].centres.y == tile.y) ++last;
        for (std::size_t r = 0; r < static_cast<std::size_t>(tile.height); ++r)
            for (std::size_t i = first; i < last; ++i) {
                const auto& found = jobs[i].found;
                for (std::size_t p = r == 0 ? 0 : found.ends[r - 1]; p < found.ends[r]; ++p) {
                    const TPeak& peak = found.peaks[p];
                    all.push_back({double(peak.column), double(tile.y) + double(r),
                                   double(peak.scale), peak.H, peak.W, peak.H * peak.W});
                }
            }
    }
    return all;
}

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
          const std::function<TJob*()>& next,
          ESimd simd,
          CThreshold& threshold) {
    CSaliencyTile<COUNT> tile(tables, simd);
    for (TJob* job = next(); job != nullptr; job = next()) {
        job->found = tile.detect(bins, job->centres, threshold.yMin());
        threshold.add(job->found.peaks);
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
    auto jobs = cut(centres);
    CThreshold threshold(limits);
    std::atomic<std::size_t> taken{0};
    const std::function<TJob*()> next = [&jobs, &taken] {
        const std::size_t i = taken++;
        return i < jobs.size() ? &jobs[i] : nullptr;
    };
    const auto worker = [&] {
        const auto run = m_tables->fitsBytes() ? work<std::uint8_t> : work<std::uint16_t>;
        run(*m_tables, bins, next, m_options.simd, threshold);
    };
    std::vector<std::future<void>> others;
    for (int i = 1; i < m_options.threads && static_cast<std::size_t>(i) < jobs.size(); ++i)
        others.push_back(std::async(std::launch::async, worker));
    worker();
    for (auto& other : others) other.get();
    auto regions = join(jobs);
    keepBest(limits.best, regions);
    return regions;
}

}  // namespace salma::saliency
