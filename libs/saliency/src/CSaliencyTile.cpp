// SPDX-License-Identifier: BSD-3-Clause
#include "CSaliencyTile.h"

#include <algorithm>
#include <cstring>

namespace salma::saliency {
namespace {

constexpr double kTie = 1e-11;          // a peak's least margin over its neighbours, a definition
constexpr double kRounding = 1 - 1e-9;  // bounds are compared with a little less than yMin

/** Sums of what stands before each of n numbers, which are 0 or 1. Eight bytes (or four words) are
 * summed at once: the product with 1 + 2^8 + 2^16 + ... has the sums up to each byte. */
template <class COUNT>
void sumBefore(const COUNT* in, COUNT* sums, int n) {
    constexpr int kAtOnce = 8 / static_cast<int>(sizeof(COUNT));
    constexpr std::uint64_t kOnes = sizeof(COUNT) == 1 ? 0x0101010101010101 : 0x0001000100010001;
    constexpr int kTop = 64 - 8 * static_cast<int>(sizeof(COUNT));
    std::uint64_t before = 0;
    for (int x = 0; x < n; x += kAtOnce) {
        std::uint64_t packed = 0;
        std::memcpy(&packed, in + x, sizeof packed);
        const std::uint64_t upTo = packed * kOnes + before * kOnes;
        const std::uint64_t exclusive = upTo - packed;
        std::memcpy(sums + x, &exclusive, sizeof exclusive);
        before = upTo >> kTop;
    }
}

}  // namespace

template <class COUNT>
CSaliencyTile<COUNT>::CSaliencyTile(const TScaleTables& tables, const TKernels<COUNT>& kernels)
    : m_tables(tables),
      m_kernels(kernels),
      m_scales(tables.scales()),
      m_plane(static_cast<std::size_t>((kTileRows + 2 * tables.sMax + 1) * tables.plan.stride)),
      m_bandCounts(static_cast<std::size_t>(m_scales * kLanes)),
      m_planes(static_cast<std::size_t>(tables.bins)),
      m_inRow(static_cast<std::size_t>(tables.bins)),
      m_scratch(hwy::AllocateAligned<COUNT>(static_cast<std::size_t>(tables.plan.scratchSize))),
      m_part(tables) {}

template <class COUNT>
void CSaliencyTile<COUNT>::detect(const cv::Mat& bins,
                                  const cv::Rect& centres,
                                  double yMin,
                                  TPeaks* rows) {
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
    const auto stride = static_cast<std::size_t>(m_tables.plan.stride);
    if (!m_planes[bin]) {
        m_planes[bin] = hwy::AllocateAligned<COUNT>(3 * m_plane);
        std::fill_n(m_planes[bin].get(), 3 * m_plane, COUNT{0});
    }
    const int first = (m_tables.plan.origin - m_tables.sMax) / 8 * 8;
    const int skipped = m_tables.plan.origin - m_tables.sMax - first;
    const int columns = (kLanes + 2 * m_tables.sMax + 1 + skipped + 7) / 8 * 8;
    COUNT* alongRow = m_planes[bin].get() + first;
    COUNT* alongColumn = alongRow + m_plane;
    COUNT* square = alongColumn + m_plane;
    std::fill_n(alongColumn, columns, COUNT{0});
    std::fill_n(square, columns, COUNT{0});
    // Columns beyond the window stay empty.
    std::vector<COUNT> inBin(static_cast<std::size_t>(columns), 0);
    for (int y = 0; y < window.height; ++y) {
        const auto* const row = bins.ptr<std::uint8_t>(window.y + y) + window.x;
        for (int x = 0; x < window.width; ++x)
            inBin[static_cast<std::size_t>(skipped + x)] = row[x] == bin ? 1 : 0;
        sumBefore(inBin.data(), alongRow, columns);
        for (int x = 0; x < columns; ++x)
            alongColumn[static_cast<int>(stride) + x] =
                static_cast<COUNT>(alongColumn[x] + inBin[static_cast<std::size_t>(x)]);
        for (int x = 0; x < columns; ++x)
            square[static_cast<int>(stride) + x] = static_cast<COUNT>(square[x] + alongRow[x]);
        alongRow += stride;
        alongColumn += stride;
        square += stride;
    }
}

template <class COUNT>
TPlanes<COUNT> CSaliencyTile<COUNT>::planesOf(std::size_t bin) const {
    const COUNT* const first = m_planes[bin].get();
    return {first, first + m_plane, first + 2 * m_plane};
}

template <class COUNT>
void CSaliencyTile<COUNT>::findPresent(int row, int count) {
    m_present.clear();
    for (std::size_t b = 0; b < m_inRow.size(); ++b) {
        const auto first = m_inRow[b].begin() + row;
        const auto last = first + (count + 2 * m_tables.sMax);
        if (std::find(first, last, 1) != last) m_present.push_back(b);
    }
}

template <class COUNT>
void CSaliencyTile<COUNT>::detectBand(const cv::Rect& centres, int row, TPeaks* rows) {
    const int count = std::min(kBandRows, centres.height - row);
    findPresent(row, count);
    const double wBound =
        *std::max_element(m_tables.wMax.begin() + m_tables.sMin + 1, m_tables.wMax.end());
    const double hBound = m_tables.log(static_cast<double>(m_present.size()));
    if (m_present.size() < 2 || !(hBound * wBound >= m_yMin * kRounding)) return;
    countBand(row, count);
    m_part.present = static_cast<int>(m_present.size());
    for (int r = 0; r < count; ++r)
        for (int x = 0; x < centres.width; x += kPart) {
            searchPart(r, x);
            emitPeaks(centres.x + x, std::min(kPart, centres.width - x), rows[row + r]);
        }
}

template <class COUNT>
void CSaliencyTile<COUNT>::countBand(int row, int count) {
    const std::size_t size = kBandRows * m_present.size() * m_bandCounts;
    if (m_discsSize < size) {
        m_discs = hwy::AllocateAligned<COUNT>(size);
        m_discsSize = size;
    }
    for (std::size_t i = 0; i < m_present.size(); ++i)
        for (int r = 0; r < count; ++r) {
            const std::size_t at = static_cast<std::size_t>(r) * m_present.size() + i;
            m_kernels.discs(m_tables, planesOf(m_present[i]), row + r + m_tables.sMax,
                            m_scratch.get(), m_discs.get() + at * m_bandCounts);
        }
}

template <class COUNT>
void CSaliencyTile<COUNT>::searchPart(int bandRow, int x) {
    const std::size_t at = static_cast<std::size_t>(bandRow) * m_present.size() * m_bandCounts;
    const COUNT* const discs = m_discs.get() + at + x;
    if (m_yMin > 0)
        m_kernels.searchAbove(m_tables, discs, m_yMin, m_part);
    else
        m_kernels.search(m_tables, discs, m_part);
}

template <class COUNT>
void CSaliencyTile<COUNT>::emitPeaks(int firstColumn, int count, TPeaks& found) const {
    for (int x = 0; x < count; ++x) {
        const int place = m_part.place[static_cast<std::size_t>(x)];
        for (int word = 0; word * kInWord < m_scales; ++word) {
            const std::uint32_t certain = m_part.certain[word * kPart + place];
            for (std::uint32_t left = m_part.possible[word * kPart + place]; left != 0;
                 left &= left - 1) {
                const int bit = __builtin_ctz(left);
                const int k = word * kInWord + bit;
                if ((certain >> bit & 1) == 0 && !isPeak(k, x)) continue;
                const double h = entropy(k, x);
                const double w = m_part.w[k * kPart + place];
                if (h * w >= m_yMin)
                    found.push_back({static_cast<std::uint16_t>(firstColumn + x),
                                     static_cast<std::uint16_t>(m_tables.sMin + k), h, w});
            }
        }
    }
}

template <class COUNT>
bool CSaliencyTile<COUNT>::isPeak(int k, int x) const {
    const double h = entropy(k, x);
    return h - entropy(k - 1, x) > kTie && h - entropy(k + 1, x) > kTie;
}

/// H = (N log N - sum n log n) / N, the sum taken over ascending bins: the canonical arithmetic.
template <class COUNT>
double CSaliencyTile<COUNT>::entropy(int k, int x) const {
    const int area = m_tables.area[static_cast<std::size_t>(m_tables.sMin + k)];
    const double* const nLogN = m_tables.nLogN.data();
    const std::uint16_t* count = m_part.counts.get() + k * m_part.present * kPart + x;
    double sum = 0;
    for (int b = 0; b < m_part.present; ++b, count += kPart) sum += nLogN[*count];
    return (nLogN[area] - sum) / area;
}

template class CSaliencyTile<std::uint8_t>;
template class CSaliencyTile<std::uint16_t>;

}  // namespace salma::saliency
