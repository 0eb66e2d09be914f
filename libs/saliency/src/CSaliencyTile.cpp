// SPDX-License-Identifier: BSD-3-Clause
#include "CSaliencyTile.h"

#include <algorithm>

namespace salma::saliency {
namespace {

constexpr double kTie = 1e-11;          // a peak's least margin over its neighbours, a definition
constexpr double kRounding = 1 - 1e-9;  // bounds are compared with a little less than yMin
constexpr std::size_t kLaneCount = kLanes;
constexpr std::size_t kGroups = kLanes / kGroup;

int roundedUp(int n) { return (n + kLanes - 1) / kLanes * kLanes; }

}  // namespace

template <class COUNT>
CSaliencyTile<COUNT>::CSaliencyTile(const TScaleTables& tables, const TKernels<COUNT>& kernels)
    : m_tables(tables),
      m_kernels(kernels),
      m_scales(static_cast<std::size_t>(tables.scales())),
      m_stride(roundedUp(kLanes + 2 * tables.sMax + 1)),
      m_planes(static_cast<std::size_t>(tables.bins)),
      m_inRow(static_cast<std::size_t>(tables.bins)),
      m_scratch(static_cast<std::size_t>(3 * (tables.sMax + 1) * m_stride)),
      m_change(m_scales * kLaneCount),
      m_w(m_scales * kLaneCount),
      m_h(m_scales * kLaneCount),
      m_needed(m_scales * kGroups) {}

template <class COUNT>
void CSaliencyTile<COUNT>::detect(const cv::Mat& bins,
                                  const cv::Rect& centres,
                                  double yMin,
                                  TRegions* rows) {
    m_yMin = yMin;
    const int reach = m_tables.sMax;
    fillPlanes(bins, {centres.x - reach, centres.y - reach, centres.width + 2 * reach,
                      centres.height + 2 * reach});
    for (int row = 0; row < centres.height; row += kBandRows) detectBand(centres, row, rows);
}

template <class COUNT>
void CSaliencyTile<COUNT>::fillPlanes(const cv::Mat& bins, const cv::Rect& window) {
    for (auto& rows : m_inRow) rows.assign(static_cast<std::size_t>(window.height), 0);
    std::vector<bool> occurs(m_planes.size());
    for (int y = 0; y < window.height; ++y) {
        const auto* const row = bins.ptr<std::uint8_t>(window.y + y) + window.x;
        for (int x = 0; x < window.width; ++x) {
            m_inRow[row[x]][static_cast<std::size_t>(y)] = 1;
            occurs[row[x]] = true;
        }
    }
    for (std::size_t b = 0; b < m_planes.size(); ++b)
        if (occurs[b]) fillPlane(bins, window, b);
}

template <class COUNT>
void CSaliencyTile<COUNT>::fillPlane(const cv::Mat& bins, const cv::Rect& window, std::size_t bin) {
    const auto stride = static_cast<std::size_t>(m_stride);
    const std::size_t plane = static_cast<std::size_t>(kTileRows + 2 * m_tables.sMax + 1) * stride;
    m_planes[bin].resize(3 * plane);
    COUNT* alongRow = m_planes[bin].data();
    COUNT* alongColumn = alongRow + plane;
    COUNT* square = alongColumn + plane;
    std::fill(alongColumn, alongColumn + stride, COUNT{0});
    std::fill(square, square + stride, COUNT{0});
    std::vector<COUNT> inBin(stride, 0);  // columns beyond the window stay empty
    for (int y = 0; y < window.height; ++y) {
        const auto* const row = bins.ptr<std::uint8_t>(window.y + y) + window.x;
        for (int x = 0; x < window.width; ++x)
            inBin[static_cast<std::size_t>(x)] = row[x] == bin ? 1 : 0;
        COUNT sum = 0;
        for (std::size_t x = 0; x < stride; ++x) {
            alongRow[x] = sum;
            sum = static_cast<COUNT>(sum + inBin[x]);
        }
        for (std::size_t x = 0; x < stride; ++x)
            alongColumn[stride + x] = static_cast<COUNT>(alongColumn[x] + inBin[x]);
        for (std::size_t x = 0; x < stride; ++x)
            square[stride + x] = static_cast<COUNT>(square[x] + alongRow[x]);
        alongRow += stride;
        alongColumn += stride;
        square += stride;
    }
}

template <class COUNT>
TPlanes<COUNT> CSaliencyTile<COUNT>::planesOf(std::size_t bin) const {
    const std::size_t plane = m_planes[bin].size() / 3;
    const COUNT* const first = m_planes[bin].data();
    return {first, first + plane, first + 2 * plane, m_stride};
}

template <class COUNT>
void CSaliencyTile<COUNT>::findPresent(int row, int count) {
    m_present.clear();
    for (std::size_t b = 0; b < m_inRow.size(); ++b) {
        const auto first = m_inRow[b].begin() + row;
        const auto last = first + (count + 2 * m_tables.sMax);
        if (std::find(first, last, 1) != last) m_present.push_back(b);
    }
    m_entropyBound = m_tables.log(static_cast<double>(m_present.size()));
}

template <class COUNT>
void CSaliencyTile<COUNT>::detectBand(const cv::Rect& centres, int row, TRegions* rows) {
    const int count = std::min(kBandRows, centres.height - row);
    findPresent(row, count);
    const double wBound =
        *std::max_element(m_tables.wMax.begin() + m_tables.sMin + 1, m_tables.wMax.end());
    if (m_present.size() < 2 || !(m_entropyBound * wBound >= m_yMin * kRounding)) return;
    const std::size_t ofBin = m_scales * kLaneCount;
    m_discs.resize(kBandRows * m_present.size() * ofBin);
    m_counts.resize(m_present.size() * ofBin);
    for (std::size_t i = 0; i < m_present.size(); ++i)
        for (int r = 0; r < count; ++r)
            m_kernels.discs(
                m_tables, planesOf(m_present[i]), row + r + m_tables.sMax, m_scratch.data(),
                m_discs.data() + (static_cast<std::size_t>(r) * m_present.size() + i) * ofBin);
    for (int r = 0; r < count; ++r) {
        sumRow(r);
        findNeeded();
        computeEntropies();
        emitPeaks({centres.x, centres.y + row + r}, centres.width, rows[row + r]);
    }
}

template <class COUNT>
void CSaliencyTile<COUNT>::sumRow(int bandRow) {
    const std::size_t ofBin = m_scales * kLaneCount;
    const COUNT* const discs =
        m_discs.data() + static_cast<std::size_t>(bandRow) * m_present.size() * ofBin;
    std::fill(m_change.begin(), m_change.end(), 0);
    for (std::size_t i = 0; i < m_present.size(); ++i)
        m_kernels.accumulate(m_tables, discs + i * ofBin, m_counts.data() + i * kLaneCount,
                             static_cast<int>(m_present.size()) * kLanes, m_change.data());
    for (std::size_t k = 1; k < m_scales; ++k) {
        const double factor = m_tables.dFactor[static_cast<std::size_t>(m_tables.sMin) + k];
        for (std::size_t x = k * kLaneCount; x < (k + 1) * kLaneCount; ++x)
            m_w[x] = m_change[x] * factor;
    }
    m_tables.smoothInPlace(m_w.data(), kLanes);
    for (std::size_t k = 1; k < m_scales; ++k) {
        const double factor = m_tables.wFactor[static_cast<std::size_t>(m_tables.sMin) + k];
        for (std::size_t x = k * kLaneCount; x < (k + 1) * kLaneCount; ++x) m_w[x] *= factor;
    }
}

template <class COUNT>
void CSaliencyTile<COUNT>::findNeeded() {
    std::fill(m_needed.begin(), m_needed.end(), std::uint8_t{0});
    for (std::size_t k = 1; k + 1 < m_scales; ++k)
        for (std::size_t g = 0; g < kGroups; ++g) {
            const double* const w = m_w.data() + k * kLaneCount + g * kGroup;
            const double largest = *std::max_element(w, w + kGroup);
            m_needed[k * kGroups + g] = largest * m_entropyBound >= m_yMin * kRounding ? 1 : 0;
        }
}

template <class COUNT>
void CSaliencyTile<COUNT>::computeEntropies() {
    for (std::size_t k = 0; k < m_scales; ++k)
        for (std::size_t g = 0; g < kGroups; ++g) {
            const std::uint8_t* const needed = m_needed.data() + k * kGroups + g;
            const bool below = k > 0 && needed[-static_cast<std::ptrdiff_t>(kGroups)] != 0;
            const bool above = k + 1 < m_scales && needed[kGroups] != 0;
            if (*needed != 0 || below || above) computeEntropies(k, g * kGroup);
        }
}

/// H = (N log N - sum n log n) / N, the sum taken over ascending bins: the canonical arithmetic.
template <class COUNT>
void CSaliencyTile<COUNT>::computeEntropies(std::size_t k, std::size_t firstLane) {
    const auto area =
        static_cast<std::size_t>(m_tables.area[static_cast<std::size_t>(m_tables.sMin) + k]);
    const double* const nLogN = m_tables.nLogN.data();
    const std::size_t present = m_present.size();
    for (std::size_t x = firstLane; x < firstLane + kGroup; x += 4) {
        const std::uint16_t* counts = m_counts.data() + k * present * kLaneCount + x;
        double sum[4] = {0, 0, 0, 0};
        for (std::size_t b = 0; b < present; ++b, counts += kLanes)
            for (std::size_t i = 0; i < 4; ++i) sum[i] += nLogN[counts[i]];
        for (std::size_t i = 0; i < 4; ++i)
            m_h[k * kLaneCount + x + i] = (nLogN[area] - sum[i]) / static_cast<double>(area);
    }
}

template <class COUNT>
void CSaliencyTile<COUNT>::emitPeaks(const cv::Point& firstCentre,
                                     int count,
                                     TRegions& found) const {
    for (std::size_t x = 0; x < static_cast<std::size_t>(count); ++x)
        for (std::size_t k = 1; k + 1 < m_scales; ++k) {
            const double* const h = m_h.data() + k * kLaneCount + x;
            if (m_needed[k * kGroups + x / kGroup] == 0 || !(h[0] - h[-kLanes] > kTie) ||
                !(h[0] - h[kLanes] > kTie))
                continue;
            const double w = m_w[k * kLaneCount + x];
            if (!(*h * w >= m_yMin)) continue;
            found.push_back({static_cast<double>(firstCentre.x) + static_cast<double>(x),
                             static_cast<double>(firstCentre.y),
                             static_cast<double>(m_tables.sMin) + static_cast<double>(k), *h, w,
                             *h * w});
        }
}

template class CSaliencyTile<std::uint8_t>;
template class CSaliencyTile<std::uint16_t>;

}  // namespace salma::saliency
