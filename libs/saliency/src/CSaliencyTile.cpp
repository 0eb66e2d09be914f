// SPDX-License-Identifier: BSD-3-Clause
#include "CSaliencyTile.h"

#include <algorithm>

namespace salma::saliency {
namespace {

constexpr double kTie = 1e-11;          // a peak's least margin over its neighbours, a definition
constexpr double kRounding = 1 - 1e-9;  // bounds are compared with a little less than yMin

}  // namespace

template <class COUNT>
CSaliencyTile<COUNT>::CSaliencyTile(const TScaleTables& tables, const TKernels<COUNT>& kernels)
    : m_tables(tables),
      m_kernels(kernels),
      m_scales(tables.scales()),
      m_ofBin(static_cast<std::size_t>(m_scales * kLanes)),
      m_bitmaps(static_cast<std::size_t>(tables.bins)),
      m_inRow(static_cast<std::size_t>(tables.bins)),
      m_part(tables) {}

template <class COUNT>
void CSaliencyTile<COUNT>::detect(const cv::Mat& bins,
                                  const cv::Rect& centres,
                                  double yMin,
                                  TPeaks* rows) {
    m_yMin = yMin;
    const int reach = m_tables.sMax;
    fillBitmaps(bins({centres.x - reach, centres.y - reach, centres.width + 2 * reach,
                      centres.height + 2 * reach}));
    for (int row = 0; row < centres.height; row += kBandRows) detectBand(centres, row, rows);
}

template <class COUNT>
void CSaliencyTile<COUNT>::fillBitmaps(const cv::Mat& window) {
    std::array<bool, 256> occurs{};
    for (int y = 0; y < window.rows; ++y) {
        const auto* const row = window.ptr<std::uint8_t>(y);
        for (int x = 0; x < window.cols; ++x) occurs[row[x]] = true;
    }
    const auto size = static_cast<std::size_t>(m_tables.bitmap.size);
    for (std::size_t b = 0; b < m_bitmaps.size(); ++b) {
        m_inRow[b].assign(static_cast<std::size_t>(window.rows), 0);
        if (!occurs[b]) continue;
        if (!m_bitmaps[b]) {
            m_bitmaps[b] = hwy::AllocateAligned<std::uint64_t>(size);
            std::fill_n(m_bitmaps[b].get(), size, 0);
        }
        m_kernels.fill(m_tables.bitmap, window, static_cast<std::uint8_t>(b), m_bitmaps[b].get(),
                       m_inRow[b].data());
    }
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
    countBand(row);
    m_part.present = static_cast<int>(m_present.size());
    for (int r = 0; r < count; ++r)
        for (int x = 0; x < centres.width; x += kPart) {
            searchPart(r, x);
            emitPeaks(centres.x + x, std::min(kPart, centres.width - x), rows[row + r]);
        }
}

template <class COUNT>
void CSaliencyTile<COUNT>::countBand(int row) {
    const std::size_t ofRow = m_present.size() * m_ofBin;
    if (m_ringsSize < kBandRows * ofRow) {
        m_rings = hwy::AllocateAligned<COUNT>(kBandRows * ofRow);
        m_ringsSize = kBandRows * ofRow;
    }
    for (std::size_t i = 0; i < m_present.size(); ++i)
        m_kernels.count(m_tables, m_bitmaps[m_present[i]].get() + row, ofRow,
                        m_rings.get() + i * m_ofBin);
}

template <class COUNT>
void CSaliencyTile<COUNT>::searchPart(int bandRow, int x) {
    const std::size_t at = static_cast<std::size_t>(bandRow) * m_present.size() * m_ofBin;
    const COUNT* const rings = m_rings.get() + at + x;
    if (m_yMin > 0)
        m_kernels.searchAbove(m_tables, rings, m_yMin, m_part);
    else
        m_kernels.search(m_tables, rings, m_part);
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
