// SPDX-License-Identifier: BSD-3-Clause
#include "CSaliencyTile.h"

#include <algorithm>
#include <numeric>

namespace salma::saliency {
namespace {

constexpr double kTie = 1e-11;          // a peak's least margin over its neighbours, a definition
constexpr double kWorthPruning = 0.5;   // with yMin below this part of log(bins) most centres stay
constexpr double kRounding = 1 - 1e-9;  // bounds are compared with a little less than yMin

}  // namespace

template <class COUNT>
CSaliencyTile<COUNT>::CSaliencyTile(const TScaleTables& tables, ESimd simd)
    : m_tables(tables),
      m_ringKernels(ringKernels<COUNT>(simd)),
      m_searchKernels(searchKernels<COUNT>(simd)),
      m_scales(tables.scales()),
      m_ofBin(static_cast<std::size_t>(m_scales * kLanes)),
      m_bitmaps(static_cast<std::size_t>(tables.bins)),
      m_perRow(static_cast<std::size_t>(tables.bins)),
      m_overlap(hwy::AllocateAligned<std::uint16_t>(kBandRows * m_ofBin)),
      m_part(tables),
      m_candidates(static_cast<std::size_t>(kPart * m_scales) + kTogether),
      m_peaks(m_candidates.size()) {}

template <class COUNT>
TTilePeaks CSaliencyTile<COUNT>::detect(const cv::Mat& bins, const cv::Rect& centres, double yMin) {
    m_yMin = yMin;
    TTilePeaks found;
    const int reach = m_tables.sMax;
    fillBitmaps(bins({centres.x - reach, centres.y - reach, centres.width + 2 * reach,
                      centres.height + 2 * reach}));
    for (int row = 0; row < centres.height; row += kBandRows) detectBand(centres, row, found);
    return found;
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
        m_perRow[b].assign(static_cast<std::size_t>(window.rows), 0);
        if (!occurs[b]) continue;
        if (!m_bitmaps[b]) {
            m_bitmaps[b] = hwy::AllocateAligned<std::uint64_t>(size);
            std::fill_n(m_bitmaps[b].get(), size, 0);
        }
        m_ringKernels.fill(m_tables.bitmap, window, static_cast<std::uint8_t>(b),
                           m_bitmaps[b].get(), m_perRow[b].data());
    }
}

template <class COUNT>
void CSaliencyTile<COUNT>::findPresent(int row, int count) {
    m_present.clear();
    for (std::size_t b = 0; b < m_perRow.size(); ++b) {
        const auto first = m_perRow[b].begin() + row;
        const auto last = first + (count + 2 * m_tables.sMax);
        if (std::any_of(first, last, [](int pixels) { return pixels > 0; })) m_present.push_back(b);
    }
}

template <class COUNT>
void CSaliencyTile<COUNT>::detectBand(const cv::Rect& centres, int row, TTilePeaks& found) {
    const int count = std::min(kBandRows, centres.height - row);
    std::fill_n(found.ends.begin() + row, count, found.peaks.size());
    findPresent(row, count);
    const double wBound =
        *std::max_element(m_tables.wMax.begin() + m_tables.sMin + 1, m_tables.wMax.end());
    const double hBound = m_tables.log(static_cast<double>(m_present.size()));
    if (m_present.size() < 2 || !(hBound * wBound >= m_yMin * kRounding)) return;
    const std::size_t size = kBandRows * m_present.size() * m_ofBin;
    if (m_ringsSize < size) {
        m_rings = hwy::AllocateAligned<COUNT>(size);
        m_ringsSize = size;
    }
    m_part.present = static_cast<int>(m_present.size());
    m_prunes = m_yMin >= kWorthPruning * hBound;
    if (m_prunes)
        countNeeded({centres.width, count}, row);
    else
        countAll(row);
    for (int r = 0; r < count; ++r) {
        for (int x = 0; x < centres.width; x += kPart) {
            if (m_prunes && m_lastScales[r][x / kPart] == 0) continue;
            searchPart(r, x);
            emitPeaks(centres.x + x, std::min(kPart, centres.width - x), found.peaks);
        }
        found.ends[static_cast<std::size_t>(row + r)] = found.peaks.size();
    }
}

template <class COUNT>
void CSaliencyTile<COUNT>::countBin(std::size_t present, int row, int scales) {
    const std::size_t bin = m_present[present];
    const auto window = m_perRow[bin].begin() + row;
    const auto end = window + std::min<std::ptrdiff_t>(m_perRow[bin].end() - window, bandWindow());
    const auto occurs = [](int pixels) { return pixels > 0; };
    const auto first = std::find_if(window, end, occurs);
    const auto last =
        std::find_if(std::make_reverse_iterator(end), std::make_reverse_iterator(first), occurs);
    const cv::Range rows(static_cast<int>(first - window), static_cast<int>(last.base() - window));
    m_ringKernels.count(m_tables, m_bitmaps[bin].get() + row, rows, scales,
                        m_present.size() * m_ofBin, m_rings.get() + present * m_ofBin);
}

template <class COUNT>
std::vector<std::size_t> CSaliencyTile<COUNT>::byPixels(int row) const {
    std::vector<std::pair<int, std::size_t>> order;
    for (std::size_t i = 0; i < m_present.size(); ++i) {
        const auto& perRow = m_perRow[m_present[i]];
        const auto first = perRow.begin() + row;
        const auto rows = std::min<std::ptrdiff_t>(perRow.end() - first, bandWindow());
        order.emplace_back(-std::accumulate(first, first + rows, 0), i);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> sorted;
    for (const auto& bin : order) sorted.push_back(bin.second);
    return sorted;
}

template <class COUNT>
void CSaliencyTile<COUNT>::countAll(int row) {
    const std::size_t most = byPixels(row).front();
    for (std::size_t i = 0; i < m_present.size(); ++i)
        if (i != most) countBin(i, row, m_scales);
    for (std::size_t r = 0; r < kBandRows; ++r)
        m_ringKernels.countRest(m_tables, static_cast<int>(m_present.size()),
                                static_cast<int>(most),
                                m_rings.get() + r * m_present.size() * m_ofBin);
}

/// W >= yMin / log(bins) means this D, smoothed; the 16-bit sums lose less than 4.
template <class COUNT>
std::vector<std::uint16_t> CSaliencyTile<COUNT>::leastChanges() const {
    const double wLeast = m_yMin / m_tables.log(static_cast<double>(m_present.size()));
    std::vector<std::uint16_t> least;
    for (int k = 0; k < m_scales; ++k) {
        const auto& bound = m_tables.bound[static_cast<std::size_t>(k)];
        const double perW =
            m_tables.wFactor[static_cast<std::size_t>(m_tables.sMin + k)] * bound.dUnit;
        const double d = k == 0 ? 0 : wLeast * kRounding / perW - 4;
        least.push_back(static_cast<std::uint16_t>(std::clamp(d, 0.0, 65535.0)));
    }
    return least;
}

template <class COUNT>
void CSaliencyTile<COUNT>::countNeeded(const cv::Size& centres, int row) {
    const auto order = byPixels(row);
    const auto least = leastChanges();
    const std::size_t ofRow = m_present.size() * m_ofBin;
    std::fill_n(m_overlap.get(), kBandRows * m_ofBin, std::uint16_t{0});
    int scales = m_scales;
    for (std::size_t i = 0; i < order.size() && scales > 0; ++i) {
        countBin(order[i], row, scales);
        m_searchKernels.addOverlap(m_tables, m_rings.get() + order[i] * m_ofBin, scales, ofRow,
                                   m_overlap.get());
        if (i % 2 == 0 && i + 1 < order.size()) continue;
        int last = 0;
        for (int r = 0; r < centres.height; ++r)
            for (int x = 0; x < centres.width; x += kPart) {
                const auto* const overlap =
                    m_overlap.get() + static_cast<std::size_t>(r) * m_ofBin + x;
                m_lastScales[r][x / kPart] = m_searchKernels.lastScale(
                    m_tables, overlap, scales, std::min(kPart, centres.width - x), least.data());
                last = std::max(last, m_lastScales[r][x / kPart]);
            }
        scales = last > 0 ? last + 2 : 0;
    }
}

template <class COUNT>
void CSaliencyTile<COUNT>::searchPart(int bandRow, int x) {
    const auto r = static_cast<std::size_t>(bandRow);
    const COUNT* const rings = m_rings.get() + r * m_present.size() * m_ofBin + x;
    if (m_prunes)
        m_searchKernels.searchAbove(m_tables, rings, m_overlap.get() + r * m_ofBin + x,
                                    m_lastScales[bandRow][x / kPart], m_yMin, m_part);
    else
        m_searchKernels.search(m_tables, rings, m_part);
}

template <class COUNT>
void CSaliencyTile<COUNT>::emitPeaks(int firstColumn, int count, std::vector<TPeak>& found) {
    const std::size_t candidates = findCandidates(count);
    std::fill_n(m_candidates.begin() + static_cast<std::ptrdiff_t>(candidates), kTogether,
                TCandidate{0, 1});
    std::array<double, kTogether> h{};
    std::size_t peaks = 0;
    for (std::size_t i = 0; i < candidates; ++i) {
        if (i % kTogether == 0) computeEntropies(&m_candidates[i], h.data());
        const auto& c = m_candidates[i];
        const double w = m_part.w[c.k * kPart + m_part.place[static_cast<std::size_t>(c.x)]];
        m_peaks[peaks] = {static_cast<std::uint16_t>(firstColumn + c.x),
                          static_cast<std::uint16_t>(m_tables.sMin + c.k), h[i % kTogether], w};
        peaks += h[i % kTogether] * w >= m_yMin ? 1 : 0;
    }
    found.insert(found.end(), m_peaks.begin(),
                 m_peaks.begin() + static_cast<std::ptrdiff_t>(peaks));
}

template <class COUNT>
std::size_t CSaliencyTile<COUNT>::findCandidates(int count) {
    TCandidate* next = m_candidates.data();
    const int scales = m_scales;
    for (int x = 0; x < count; ++x) {
        const int place = m_part.place[static_cast<std::size_t>(x)];
        for (int first = 0; first < scales; first += kInWord) {
            const int word = first / kInWord * kPart + place;
            const std::uint32_t certain = m_part.certain[word];
            for (std::uint32_t left = m_part.possible[word]; left != 0; left &= left - 1) {
                const int bit = __builtin_ctz(left);
                *next = {x, first + bit};
                next += (certain >> bit & 1) != 0 || isPeak(first + bit, x) ? 1 : 0;
            }
        }
    }
    return static_cast<std::size_t>(next - m_candidates.data());
}

template <class COUNT>
bool CSaliencyTile<COUNT>::isPeak(int k, int x) const {
    const std::array<TCandidate, kTogether> around{{{x, k - 1}, {x, k}, {x, k + 1}, {x, k}}};
    std::array<double, kTogether> h{};
    computeEntropies(around.data(), h.data());
    return h[1] - h[0] > kTie && h[1] - h[2] > kTie;
}

/// H = (N log N - sum n log n) / N, the sum taken over ascending bins: the canonical arithmetic.
template <class COUNT>
void CSaliencyTile<COUNT>::computeEntropies(const TCandidate* candidates, double* h) const {
    const double* const nLogN = m_tables.nLogN.data();
    std::array<const std::uint16_t*, kTogether> counts{};
    std::array<double, kTogether> sums{};
    for (std::size_t i = 0; i < kTogether; ++i)
        counts[i] = m_part.countsOf(candidates[i].k) + candidates[i].x;
    for (int b = 0; b < m_part.present; ++b)
        for (std::size_t i = 0; i < kTogether; ++i) sums[i] += nLogN[counts[i][b * kPart]];
    for (std::size_t i = 0; i < kTogether; ++i) {
        const int area = m_tables.area[static_cast<std::size_t>(m_tables.sMin + candidates[i].k)];
        h[i] = (nLogN[area] - sums[i]) / area;
    }
}

template class CSaliencyTile<std::uint8_t>;
template class CSaliencyTile<std::uint16_t>;

}  // namespace salma::saliency
