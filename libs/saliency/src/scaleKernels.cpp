// SPDX-License-Identifier: BSD-3-Clause
#include "scaleKernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <string>

// Every instruction set that the compiler knows, the portable one included; others would add
// nothing (SSSE3) or have vectors whose size is known too late (SVE).
#define HWY_COMPILE_ALL_ATTAINABLE
#define HWY_WANT_AVX3_DL  // AVX-512 since Ice Lake and Zen 4: transposes bits in one instruction
#define HWY_BROKEN_EMU128 0  // the portable one; tests show that g++ 12.2 does it no harm here
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scaleKernels.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
#if HWY_TARGET == HWY_AVX3_DL
#pragma GCC push_options
#pragma GCC target("gfni")  // Highway 1.0 leaves it out
#endif
namespace salma::saliency {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::CappedTag<std::uint16_t, kPart>;
using D32 = hn::RepartitionToWide<D16>;
using DInt = hn::RebindToSigned<D32>;
using DFloat = hn::RebindToFloat<D32>;
using DDouble = hn::CappedTag<double, kPart>;
using VWords = hn::Vec<D32>;
using VInts = hn::Vec<DInt>;
using VFloats = hn::Vec<DFloat>;

constexpr int kShorts = static_cast<int>(hn::MaxLanes(D16()));
constexpr int kFloats = static_cast<int>(hn::MaxLanes(DFloat()));
constexpr int kDoubles = static_cast<int>(hn::MaxLanes(DDouble()));

// ---------------------------------------------------------------- counting

using D64 = hn::CappedTag<std::uint64_t, kBandRows>;  // one word of kLanes bits for each row
using V64 = hn::Vec<D64>;
constexpr int kWords = static_cast<int>(hn::MaxLanes(D64()));
constexpr int kMaxWords = 2 * 128 / 64 + 2;  // of a row of the largest window

/// Bits of the pixels of a row that are in a bin; `words` has room for two words more.
HWY_INLINE void bitsOf(const std::uint8_t* row, int width, std::uint8_t bin, std::uint64_t* words) {
    const hn::CappedTag<std::uint8_t, kLanes> d;
    constexpr int n = static_cast<int>(hn::MaxLanes(d));
    auto* const bytes = reinterpret_cast<std::uint8_t*>(words);
    int x = 0;
    for (; x + n <= width; x += n)
        hn::StoreMaskBits(d, hn::Eq(hn::LoadU(d, row + x), hn::Set(d, bin)), bytes + x / 8);
    std::uint64_t rest[2] = {0, 0};
    for (int i = 0; x + i < width; ++i)
        rest[i / 64] |= static_cast<std::uint64_t>(row[x + i] == bin) << (i % 64);
    std::memcpy(bytes + x / 8, rest, sizeof rest);
}

void fill(const TBitmapLayout& layout,
          const cv::Mat& window,
          std::uint8_t bin,
          std::uint64_t* bitmap,
          std::uint16_t* perRow) {
    const D64 d;
    const int words = 2 * layout.reach / 64 + 2;
    HWY_ALIGN std::uint64_t rows[kMaxWords * kBandRows] = {};  // [word][row]
    HWY_ALIGN std::uint64_t row[kMaxWords + 2] = {};
    for (int y = 0; y < window.rows; y += kBandRows) {
        bool some = false;
        for (int r = 0; r < std::min(kBandRows, window.rows - y); ++r) {
            bitsOf(window.ptr<std::uint8_t>(y + r), window.cols, bin, row);
            std::size_t pixels = 0;
            for (int i = 0; i < words; ++i) {
                rows[i * kBandRows + r] = row[i];
                pixels += hwy::PopCount(row[i]);
            }
            perRow[y + r] = static_cast<std::uint16_t>(pixels);
            some = some || pixels > 0;
        }
        if (!some) {
            for (int shift = 0; shift <= 2 * layout.reach; ++shift)
                std::fill_n(bitmap + shift * layout.stride + y, kBandRows, std::uint64_t{0});
            continue;
        }
        for (int r = 0; r < kBandRows; r += kWords)
            for (int shift = 0; shift <= 2 * layout.reach; ++shift) {
                const std::uint64_t* const word = rows + shift / 64 * kBandRows + r;
                const auto low = hn::ShiftRightSame(hn::Load(d, word), shift % 64);
                // Two shifts, as one by 64 has no defined result.
                const auto high = hn::ShiftLeftSame(hn::ShiftLeft<1>(hn::Load(d, word + kBandRows)),
                                                    63 - shift % 64);
                hn::Store(hn::Or(low, high), d, bitmap + shift * layout.stride + y + r);
            }
    }
}

/// Adds a and b to sum, bit by bit, and returns the carries.
HWY_INLINE V64 addBits(V64& sum, V64 a, V64 b) {
#if HWY_TARGET <= HWY_AVX3
    const V64 carry{_mm512_ternarylogic_epi64(sum.raw, a.raw, b.raw, 0xe8)};
    sum = V64{_mm512_ternarylogic_epi64(sum.raw, a.raw, b.raw, 0x96)};
#else
    const auto either = hn::Xor(a, b);
    const auto carry = hn::Or(hn::And(a, b), hn::And(sum, either));
    sum = hn::Xor(sum, either);
#endif
    return carry;
}

/// Adds 2^LEVEL ring pixels to the planes below LEVEL, and returns the carries into that plane.
template <int LEVEL>
HWY_INLINE V64 addPixels(const std::uint64_t* bitmap, const std::int32_t* at, V64* plane) {
    const D64 d;
    if constexpr (LEVEL == 1) {
        return addBits(plane[0], hn::LoadU(d, bitmap + at[0]), hn::LoadU(d, bitmap + at[1]));
    } else {
        const auto first = addPixels<LEVEL - 1>(bitmap, at, plane);
        const auto second = addPixels<LEVEL - 1>(bitmap, at + (1 << (LEVEL - 1)), plane);
        return addBits(plane[LEVEL - 1], first, second);
    }
}

template <int FROM, int PLANES>
HWY_INLINE void addCarry(V64 carry, V64* plane) {
    for (int p = FROM; p < PLANES; ++p) {
        const auto next = hn::And(plane[p], carry);
        plane[p] = hn::Xor(plane[p], carry);
        carry = next;
    }
}

/** Counts ring pixels with carry-save adders: plane p gets bit p of each centre's count.
 * Source: R. D. Harley and D. Seal; H. S. Warren, "Hacker's Delight", 2nd ed., section 5-1. */
template <int PLANES>
HWY_INLINE void sumRing(const std::int32_t* first,
                        const std::int32_t* last,
                        const std::uint64_t* bitmap,
                        V64 (&plane)[PLANES]) {
    static_assert(kAtOnce == 8, "counted by 2^3, or twice that");
    for (auto& p : plane) p = hn::Zero(D64());
    const std::int32_t* at = first;
    for (; last - at >= 16; at += 16) addCarry<4, PLANES>(addPixels<4>(bitmap, at, plane), plane);
    if (at != last) addCarry<3, PLANES>(addPixels<3>(bitmap, at, plane), plane);
}

#if HWY_TARGET == HWY_AVX3_DL

/// The bytes whose bits are eight planes of eight rows.
HWY_INLINE void joinPlanes(V64 (&p)[8], std::size_t stride, std::uint8_t* out) {
    static_assert(kWords == 8);
    __m512i pair[2][4];  // planes 2i and 2i+1 of even and of odd rows
    for (int i = 0; i < 4; ++i) {
        pair[0][i] = _mm512_unpacklo_epi64(p[2 * i].raw, p[2 * i + 1].raw);
        pair[1][i] = _mm512_unpackhi_epi64(p[2 * i].raw, p[2 * i + 1].raw);
    }
    // Byte c of planes 7..0 together, as the 8 x 8 bits that the affine map of unit vectors turns.
    HWY_ALIGN std::uint8_t order[64];
    for (int i = 0; i < 64; ++i) order[i] = static_cast<std::uint8_t>((7 - i % 8) * 8 + i / 8);
    const auto together = _mm512_load_si512(order);
    const auto units = _mm512_set1_epi64(static_cast<std::int64_t>(0x8040201008040201));
    const auto store = [&](std::size_t row, __m512i planes) {
        const auto bits = _mm512_permutexvar_epi8(together, planes);
        _mm512_store_si512(out + row * stride, _mm512_gf2p8affine_epi64_epi8(units, bits, 0));
    };
    for (std::size_t odd = 0; odd < 2; ++odd) {
        const auto& q = pair[odd];
        const auto low04 = _mm512_shuffle_i64x2(q[0], q[1], 0x88);
        const auto high04 = _mm512_shuffle_i64x2(q[2], q[3], 0x88);
        const auto low26 = _mm512_shuffle_i64x2(q[0], q[1], 0xdd);
        const auto high26 = _mm512_shuffle_i64x2(q[2], q[3], 0xdd);
        store(odd, _mm512_shuffle_i64x2(low04, high04, 0x88));
        store(odd + 2, _mm512_shuffle_i64x2(low26, high26, 0x88));
        store(odd + 4, _mm512_shuffle_i64x2(low04, high04, 0xdd));
        store(odd + 6, _mm512_shuffle_i64x2(low26, high26, 0xdd));
    }
}

#else

/// Swaps the bits i + SHIFT of `low` with the bits i of `high`, for the bits i of `mask`.
template <int SHIFT>
HWY_INLINE void swapBits(V64& low, V64& high, std::uint64_t mask) {
    const D64 d;
    const auto different = hn::And(hn::Xor(hn::ShiftRight<SHIFT>(low), high), hn::Set(d, mask));
    high = hn::Xor(high, different);
    low = hn::Xor(low, hn::ShiftLeft<SHIFT>(different));
}

/// Stores the 16-byte blocks of a vector, each in the row after the next.
template <class D>
HWY_INLINE void storeBlocks(D d, hn::Vec<D> v, std::size_t stride, std::uint8_t* out) {
    if constexpr (hn::MaxLanes(D()) > 16) {
        const hn::Half<D> half;
        storeBlocks(half, hn::LowerHalf(half, v), stride, out);
        storeBlocks(half, hn::UpperHalf(half, v), stride, out + hn::MaxLanes(half) / 8 * stride);
    } else {
        hn::Store(v, d, out);
    }
}

/** The bytes whose bits are eight planes of kWords rows: transposes the bits of each byte with
 * those of the other planes' byte, then brings the bytes into the order of columns. */
HWY_INLINE void joinPlanes(V64 (&p)[8], std::size_t stride, std::uint8_t* out) {
    for (int i = 0; i < 8; i += 2) swapBits<1>(p[i], p[i + 1], 0x5555555555555555);
    for (const int i : {0, 1, 4, 5}) swapBits<2>(p[i], p[i + 2], 0x3333333333333333);
    for (int i = 0; i < 4; ++i) swapBits<4>(p[i], p[i + 4], 0x0f0f0f0f0f0f0f0f);
    const hn::Repartition<std::uint8_t, D64> d8;
    const hn::Repartition<std::uint16_t, D64> d16;
    const hn::Repartition<std::uint32_t, D64> d32;
    hn::Vec<decltype(d16)> pairs[2][4];  // of even and of odd rows
    for (int i = 0; i < 4; ++i) {
        const auto a = hn::BitCast(d8, p[2 * i]);
        const auto b = hn::BitCast(d8, p[2 * i + 1]);
        pairs[0][i] = hn::BitCast(d16, hn::InterleaveLower(d8, a, b));
        pairs[1][i] = hn::BitCast(d16, hn::InterleaveUpper(d8, a, b));
    }
    for (int odd = 0; odd < 2; ++odd) {
        const auto& pair = pairs[odd];
        hn::Vec<decltype(d32)> fours[2][2] = {
            {hn::BitCast(d32, hn::InterleaveLower(d16, pair[0], pair[1])),
             hn::BitCast(d32, hn::InterleaveLower(d16, pair[2], pair[3]))},
            {hn::BitCast(d32, hn::InterleaveUpper(d16, pair[0], pair[1])),
             hn::BitCast(d32, hn::InterleaveUpper(d16, pair[2], pair[3]))}};
        std::uint8_t* row = out + static_cast<std::size_t>(odd) * stride;
        for (const auto& four : fours) {
            const auto low = hn::InterleaveLower(d32, four[0], four[1]);
            const auto high = hn::InterleaveUpper(d32, four[0], four[1]);
            storeBlocks(d8, hn::BitCast(d8, low), stride, row);
            storeBlocks(d8, hn::BitCast(d8, high), stride, row + 16);
            row += 32;
        }
    }
}

#endif

template <int PLANES>
void countRing(const std::int32_t* first,
               const std::int32_t* last,
               const std::uint64_t* bitmap,
               std::size_t stride,
               std::uint8_t* out) {
    static_assert(kWords >= 2, "joinPlanes works on pairs of rows");
    for (std::size_t r = 0; r < kBandRows; r += kWords) {
        V64 planes[PLANES];
        sumRing(first, last, bitmap + r, planes);
        V64 eight[8];
        for (int p = 0; p < 8; ++p) eight[p] = p < PLANES ? planes[p] : hn::Zero(D64());
        joinPlanes(eight, stride, out + r * stride);
    }
}

/// As above, for counts beyond a byte.
template <int PLANES>
void countRing(const std::int32_t* first,
               const std::int32_t* last,
               const std::uint64_t* bitmap,
               std::size_t stride,
               std::uint16_t* out) {
    const hn::Rebind<std::uint8_t, D16> d8;
    const D16 d16;
    HWY_ALIGN std::uint8_t bytes[2][kWords * kLanes];
    for (std::size_t r = 0; r < kBandRows; r += kWords) {
        V64 planes[16];
        sumRing(first, last, bitmap + r, planes);
        V64 eight[8];
        for (int high = 0; high < 2; ++high) {
            std::copy(planes + 8 * high, planes + 8 * high + 8, eight);
            joinPlanes(eight, kLanes, bytes[high]);
        }
        for (std::size_t x = 0; x < kWords * kLanes; x += kShorts) {
            const auto low = hn::PromoteTo(d16, hn::Load(d8, bytes[0] + x));
            const auto high = hn::PromoteTo(d16, hn::Load(d8, bytes[1] + x));
            hn::Store(hn::Or(low, hn::ShiftLeft<8>(high)), d16,
                      out + (r + x / kLanes) * stride + x % kLanes);
        }
    }
}

template <class COUNT>
void count(const TScaleTables& tables,
           const std::uint64_t* bitmap,
           const cv::Range& rows,
           int scales,
           std::size_t stride,
           COUNT* out) {
    // A vector of row dy has pixels of the rows from dy + reach to dy + reach + kBandRows - 1.
    const auto firstRow = static_cast<std::size_t>(std::max(rows.start - kBandRows + 1, 0));
    const auto endRow = static_cast<std::size_t>(std::min(rows.end, 2 * tables.bitmap.reach + 1));
    for (int k = 0; k < scales; ++k, out += kLanes) {
        const auto& ring = tables.rings[static_cast<std::size_t>(k)];
        const std::size_t first = ring.rowStarts[firstRow] / kAtOnce * kAtOnce;
        const std::size_t end = (ring.rowStarts[endRow] + kAtOnce - 1) / kAtOnce * kAtOnce;
        const std::int32_t* const offsets = ring.offsets.data();
        const int most = tables.inRing(k);
        if (first >= end)
            for (std::size_t r = 0; r < kBandRows; ++r)
                std::fill_n(out + r * stride, kLanes, COUNT{0});
        else if (most < 64)
            countRing<6>(offsets + first, offsets + end, bitmap, stride, out);
        else if (most < 128)
            countRing<7>(offsets + first, offsets + end, bitmap, stride, out);
        else
            countRing<8>(offsets + first, offsets + end, bitmap, stride, out);
    }
}

template <class COUNT>
void countRest(const TScaleTables& tables, int present, int which, COUNT* rings) {
    const hn::CappedTag<COUNT, kLanes> d;
    constexpr int n = static_cast<int>(hn::MaxLanes(d));
    const int ofBin = tables.scales() * kLanes;
    for (int k = 0; k < tables.scales(); ++k)
        for (int x = 0; x < kLanes; x += n) {
            const COUNT* ring = rings + k * kLanes + x;
            auto rest = hn::Set(d, static_cast<COUNT>(tables.inRing(k)));
            for (int b = 0; b < present; ++b, ring += ofBin)
                if (b != which) rest = hn::Sub(rest, hn::Load(d, ring));
            hn::Store(rest, d, rings + which * ofBin + k * kLanes + x);
        }
}

// ---------------------------------------------------------------- searching

/// Pixels of a ring, as words.
HWY_INLINE hn::Vec<D16> ringOf(const std::uint8_t* ring) {
    return hn::PromoteTo(D16(), hn::Load(hn::Rebind<std::uint8_t, D16>(), ring));
}

HWY_INLINE hn::Vec<D16> ringOf(const std::uint16_t* ring) { return hn::Load(D16(), ring); }

/// max(0, r N - n R) of pairs (r in the lower half, n in the upper half of a word).
template <class COUNT>
HWY_INLINE VInts growth(VWords pairs, VInts area, VInts ring, [[maybe_unused]] VInts both) {
    const DInt d;
    VInts difference;
#if HWY_TARGET <= HWY_AVX3
    if constexpr (sizeof(COUNT) == 1)  // counts below 2^15
        return hn::Max(VInts{_mm512_madd_epi16(pairs.raw, both.raw)}, hn::Zero(d));
#elif HWY_TARGET == HWY_AVX2
    if constexpr (sizeof(COUNT) == 1)
        return hn::Max(VInts{_mm256_madd_epi16(pairs.raw, both.raw)}, hn::Zero(d));
#elif HWY_TARGET == HWY_SSE4
    if constexpr (sizeof(COUNT) == 1)
        return hn::Max(VInts{_mm_madd_epi16(pairs.raw, both.raw)}, hn::Zero(d));
#endif
    const auto r = hn::BitCast(d, hn::And(pairs, hn::Set(D32(), 0xffff)));
    const auto n = hn::BitCast(d, hn::ShiftRight<16>(pairs));
    difference = hn::Sub(hn::Mul(r, area), hn::Mul(n, ring));
    return hn::Max(difference, hn::Zero(d));
}

/** n log2(n / N), to 3e-5 n. The exponent of n and its mantissa m less 1 are the bits of the float
 * n; a polynomial adds what log2(m) has beyond m - 1. */
class CLogs {
 public:
    explicit CLogs(float log2Area) : m_constant(hn::Set(d, kC[0] - 127 - log2Area)) {}

    HWY_INLINE VFloats addTo(VFloats sum, VInts n) const {
        const auto f = hn::ConvertTo(d, n);
        const auto bits = hn::BitCast(DInt(), f);
        const auto m = hn::BitCast(
            d, hn::OrAnd(hn::Set(DInt(), 0x3f800000), bits, hn::Set(DInt(), 0x007fffff)));
        auto p = hn::MulAdd(hn::Set(d, kC[5]), m, hn::Set(d, kC[4]));
        p = hn::MulAdd(p, m, hn::Set(d, kC[3]));
        p = hn::MulAdd(p, m, hn::Set(d, kC[2]));
        p = hn::MulAdd(p, m, hn::Set(d, kC[1]));
        p = hn::MulAdd(p, m, m_constant);
        const auto log = hn::MulAdd(hn::ConvertTo(d, bits), hn::Set(d, 1.0F / (1 << 23)), p);
        return hn::MulAdd(f, log, sum);
    }

 private:
    // Minimax polynomial of log2(m) - (m - 1) on [1, 2]: 1.3e-5.
    static constexpr float kC[6] = {-1.80036404F, 4.09171081F,   -3.55079293F,
                                    1.63114877F,  -0.416563687F, 0.0448736103F};
    static constexpr DFloat d{};
    VFloats m_constant;
};

/// Orders the bins by the first scale at which they occur about the centres of a part.
template <class COUNT>
void orderBins(const TScaleTables& tables, const COUNT* rings, TPart& part) {
    const hn::CappedTag<COUNT, kPart> d;
    constexpr int n = static_cast<int>(hn::MaxLanes(d));
    part.firstScale.clear();
    part.order.clear();
    for (int b = 0; b < part.present; ++b, rings += tables.scales() * kLanes) {
        int k = 0;
        const auto occurs = [&] {
            auto any = hn::Zero(d);
            for (int x = 0; x < kPart; x += n)
                any = hn::Or(any, hn::Load(d, rings + k * kLanes + x));
            return !hn::AllTrue(d, hn::Eq(any, hn::Zero(d)));
        };
        while (k < tables.scales() && !occurs()) ++k;
        const auto at = std::upper_bound(part.firstScale.begin(), part.firstScale.end(), k);
        part.order.insert(part.order.begin() + (at - part.firstScale.begin()), b);
        part.firstScale.insert(at, k);
    }
}

/// Counts, changes and entropies of all scales.
template <class COUNT>
void sumAll(const TScaleTables& tables, const COUNT* rings, TPart& part) {
    const D16 d16;
    const DInt di;
    const DFloat df;
    orderBins(tables, rings, part);
    std::fill_n(part.countsOf(-1), part.present * kPart, std::uint16_t{0});
    const int scales = tables.scales();
    const int ofScale = part.present * kPart;
    const COUNT* ringsOf[256];  // of the bins in order of their first scales
    std::uint16_t* countsOf[256];
    for (int i = 0; i < part.present; ++i) {
        const int b = part.order[static_cast<std::size_t>(i)];
        ringsOf[i] = rings + b * scales * kLanes;
        countsOf[i] = part.countsOf(0) + b * kPart;
    }
    int active = 0;
    for (int k = 0; k < scales; ++k) {
        while (active < part.present && part.firstScale[static_cast<std::size_t>(active)] <= k)
            ++active;
        const auto s = static_cast<std::size_t>(tables.sMin + k);
        const int area = tables.area[s];
        const int inRing = k > 0 ? tables.inRing(k) : 0;
        const auto areas = hn::Set(di, area);
        const auto inRings = hn::Set(di, inRing);
        const auto both = hn::Set(di, (area & 0xffff) | -inRing * 65536);
        const CLogs logs(tables.bound[static_cast<std::size_t>(k)].log2Area);
        for (int x = 0; x < kPart; x += kShorts) {
            const int ring = k * kLanes + x;
            const int count = k * ofScale + x;
            auto change0 = hn::Zero(di);
            auto change1 = hn::Zero(di);
            auto sum0 = hn::Zero(df);
            auto sum1 = hn::Zero(df);
            for (int i = 0; i < active; ++i) {
                const auto r = ringOf(ringsOf[i] + ring);
                const auto n = hn::Add(r, hn::Load(d16, countsOf[i] + count - ofScale));
                hn::Store(n, d16, countsOf[i] + count);
                const auto pairs0 = hn::ZipLower(r, n);
                const auto pairs1 = hn::ZipUpper(D32(), r, n);
                change0 = hn::Add(change0, growth<COUNT>(pairs0, areas, inRings, both));
                change1 = hn::Add(change1, growth<COUNT>(pairs1, areas, inRings, both));
                sum0 = logs.addTo(sum0, hn::BitCast(di, hn::ShiftRight<16>(pairs0)));
                sum1 = logs.addTo(sum1, hn::BitCast(di, hn::ShiftRight<16>(pairs1)));
            }
            for (int i = active; i < part.present; ++i)
                hn::Store(hn::Zero(d16), d16, countsOf[i] + count);
            const auto factor = hn::Set(df, -1.0F / static_cast<float>(area));
            std::int32_t* const change = part.change.get() + k * kPart + x;
            float* const entropy = part.entropy.get() + k * kPart + x;
            hn::Store(change0, di, change);
            hn::Store(change1, di, change + kFloats);
            hn::Store(hn::Mul(sum0, factor), df, entropy);
            hn::Store(hn::Mul(sum1, factor), df, entropy + kFloats);
        }
    }
}

/** W of `count` places from `first` on at scales 1..lastScale-1, from their changes up to
 * lastScale. The order of operations is part of the result. */
HWY_INLINE void computeW(
    const TScaleTables& tables, int first, int count, int lastScale, TPart& part) {
    const DDouble d;
    const hn::Rebind<std::int32_t, DDouble> di;
    constexpr int kChains = 4;  // each step waits for the one before
    const auto third = hn::Set(d, 1.0 / 3.0);
    for (int begin = first; begin < first + count; begin += kChains * kDoubles) {
        const int chains = std::min(kChains, (first + count - begin) / kDoubles);
        const auto dAt = [&](int k, int chain) {
            const std::int32_t* const change = part.change.get() + k * kPart + begin;
            return hn::Mul(hn::PromoteTo(d, hn::Load(di, change + chain * kDoubles)),
                           hn::Set(d, tables.dFactor[static_cast<std::size_t>(tables.sMin + k)]));
        };
        hn::Vec<DDouble> now[kChains];
        hn::Vec<DDouble> smoothed[kChains];
        for (int i = 0; i < chains; ++i) smoothed[i] = now[i] = dAt(1, i);  // D(sMin) is D(sMin+1)
        for (int k = 1; k < lastScale; ++k) {
            const auto factor =
                hn::Set(d, tables.wFactor[static_cast<std::size_t>(tables.sMin + k)]);
            double* const w = part.w.get() + k * kPart + begin;
            for (int i = 0; i < chains; ++i) {
                const auto next = dAt(k + 1, i);
                smoothed[i] = tables.smooth
                                  ? hn::Mul(hn::Add(smoothed[i], hn::Add(now[i], next)), third)
                                  : now[i];
                now[i] = next;
                hn::Store(hn::Mul(smoothed[i], factor), d, w + i * kDoubles);
            }
        }
    }
}

HWY_INLINE void clearMarks(const TScaleTables& tables, TPart& part) {
    const int n = (tables.scales() + kInWord - 1) / kInWord * kPart;
    std::fill_n(part.certain.get(), n, 0U);
    std::fill_n(part.possible.get(), n, 0U);
}

/// Entropies further apart than this are so in truth as well [bit].
HWY_INLINE float marginOf(const TPart& part) {
    return 8e-5F + 1e-6F * static_cast<float>(part.present);
}

/// Less than any entropy but 0, more than any estimate of 0 [bit].
constexpr float kNone = 1e-4F;

/** Collects the marks of the places from x on, in registers until a word is full or done. */
class CMarks {
 public:
    HWY_INLINE CMarks(int x, TPart& part)
        : m_x(x),
          m_margin(marginOf(part)),
          m_certain(hn::Zero(d)),
          m_possible(hn::Zero(d)),
          m_part(part) {}
    HWY_INLINE ~CMarks() { store(); }
    CMarks(const CMarks&) = delete;
    CMarks& operator=(const CMarks&) = delete;

    /// Scale k, which `allowed` may forbid, by the entropies at k - 1, k and k + 1.
    HWY_INLINE void add(
        int k, VFloats before, VFloats at, VFloats after, hn::Mask<DFloat> allowed) {
        const DFloat df;
        if (k / kInWord != m_word) {
            store();
            m_certain = m_possible = hn::Zero(d);
            m_word = k / kInWord;
        }
        const auto least = hn::Min(hn::Sub(at, before), hn::Sub(at, after));
        const auto bit = hn::Set(d, 1U << (k % kInWord));
        const auto some = hn::And(allowed, hn::Gt(at, hn::Set(df, kNone)));
        const auto marked = [&](float above) {
            const auto mask = hn::And(some, hn::Gt(least, hn::Set(df, above)));
            return hn::IfThenElseZero(hn::RebindMask(d, mask), bit);
        };
        m_certain = hn::Or(m_certain, marked(m_margin));
        m_possible = hn::Or(m_possible, marked(-m_margin));
    }

 private:
    HWY_INLINE void store() {
        hn::Store(m_certain, d, m_part.certain.get() + m_word * kPart + m_x);
        hn::Store(m_possible, d, m_part.possible.get() + m_word * kPart + m_x);
    }

    static constexpr D32 d{};
    int m_x;
    int m_word{0};
    float m_margin;
    VWords m_certain;
    VWords m_possible;
    TPart& m_part;
};

template <class COUNT>
void search(const TScaleTables& tables, const COUNT* rings, TPart& part) {
    const DFloat d;
    sumAll(tables, rings, part);
    const int scales = tables.scales();
    computeW(tables, 0, kPart, scales - 1, part);
    clearMarks(tables, part);
    const auto all = hn::FirstN(d, kFloats);
    for (int x = 0; x < kPart; x += kFloats) {
        CMarks marks(x, part);
        const float* const entropy = part.entropy.get() + x;
        auto before = hn::Load(d, entropy);
        auto at = hn::Load(d, entropy + kPart);
        for (int k = 1; k + 1 < scales; ++k) {
            const auto after = hn::Load(d, entropy + (k + 1) * kPart);
            marks.add(k, before, at, after, all);
            before = at;
            at = after;
        }
    }
    // What ZipLower and ZipUpper do to the order of centres.
    HWY_ALIGN std::uint16_t centres[kPart];
    HWY_ALIGN std::uint32_t zipped[kPart];
    for (int x = 0; x < kPart; ++x) centres[x] = static_cast<std::uint16_t>(x);
    const D16 d16;
    for (int x = 0; x < kPart; x += kShorts) {
        const auto c = hn::Load(d16, centres + x);
        hn::Store(hn::ZipLower(c, hn::Zero(d16)), D32(), zipped + x);
        hn::Store(hn::ZipUpper(D32(), c, hn::Zero(d16)), D32(), zipped + x + kFloats);
    }
    for (int i = 0; i < kPart; ++i) part.place[zipped[i]] = static_cast<std::uint8_t>(i);
}

// ---------------------------------------------------------------- searching above a threshold

constexpr double kRoundedUp = 1 + 1e-5;  // more than what floats lose

template <class COUNT>
void addOverlap(const TScaleTables& tables,
                const COUNT* rings,
                int scales,
                std::size_t stride,
                std::uint16_t* overlap) {
    const D16 d;
    for (int row = 0; row < kBandRows; ++row, rings += stride, overlap += tables.scales() * kLanes)
        for (int x = 0; x < kLanes; x += kShorts) {
            auto n = ringOf(rings + x);
            for (int k = 1; k < scales; ++k) {
                const auto& bound = tables.bound[static_cast<std::size_t>(k)];
                const auto r = ringOf(rings + k * kLanes + x);
                const auto inRing = hn::Mul(r, hn::Set(d, bound.perPixel));
                const auto inDisc =
                    hn::MulHigh(hn::Mul(n, hn::Set(d, bound.toTop)), hn::Set(d, bound.perTop));
                std::uint16_t* const sum = overlap + k * kLanes + x;
                hn::Store(hn::Add(hn::Load(d, sum), hn::Min(inRing, inDisc)), d, sum);
                n = hn::Add(n, r);
            }
        }
}

int lastScale(const TScaleTables& tables,
              const std::uint16_t* overlap,
              int scales,
              int count,
              const std::uint16_t* atLeast) {
    const D16 d;
    const auto third = hn::Set(d, 65536 / 3);
    auto last = hn::Zero(d);
    for (int x = 0; x < count; x += kShorts) {
        const auto dAt = [&](int k) {
            const auto& bound = tables.bound[static_cast<std::size_t>(k)];
            const auto rest =
                hn::Sub(hn::Set(d, bound.whole), hn::Load(d, overlap + k * kLanes + x));
            return hn::MulHigh(rest, hn::Set(d, bound.toD));
        };
        auto now = dAt(1);
        auto smoothed = now;
        auto found = hn::Zero(d);
        for (int k = 1; k + 1 < scales; ++k) {
            const auto next = dAt(k + 1);
            smoothed =
                tables.smooth ? hn::MulHigh(hn::Add(hn::Add(smoothed, now), next), third) : now;
            now = next;
            const auto high = hn::Eq(hn::Max(smoothed, hn::Set(d, atLeast[k])), smoothed);
            found = hn::IfThenElse(high, hn::Set(d, static_cast<std::uint16_t>(k)), found);
        }
        const auto exist = hn::FirstN(d, static_cast<std::size_t>(std::min(kShorts, count - x)));
        last = hn::Max(last, hn::IfThenElseZero(exist, found));
    }
    HWY_ALIGN std::uint16_t lanes[kShorts];
    hn::Store(last, d, lanes);
    return *std::max_element(lanes, lanes + kShorts);
}

/// Counts of scales 0..lastScale.
template <class COUNT>
void sumCounts(const TScaleTables& tables, const COUNT* rings, int lastScale, TPart& part) {
    const D16 d;
    for (int b = 0; b < part.present; ++b, rings += tables.scales() * kLanes)
        for (int x = 0; x < kPart; x += kShorts) {
            auto n = hn::Zero(d);
            for (int k = 0; k <= lastScale; ++k) {
                n = hn::Add(n, ringOf(rings + k * kLanes + x));
                hn::Store(n, d, part.countsOf(k) + b * kPart + x);
            }
        }
}

/// Bounds of W up to lastScale, in the order of centres.
HWY_INLINE void boundW(const TScaleTables& tables,
                       const std::uint16_t* overlap,
                       int lastScale,
                       TPart& part) {
    const DFloat d;
    const DInt di;
    const hn::Rebind<std::uint16_t, DFloat> d16;
    for (int x = 0; x < kPart; x += kFloats) {
        const auto dAt = [&](int k) {
            const auto s = static_cast<std::size_t>(tables.sMin + k);
            const int whole = tables.bound[static_cast<std::size_t>(k)].whole;
            const double factor = 2.0 * tables.inRing(k) / tables.area[s] / whole;
            const auto same = hn::PromoteTo(di, hn::Load(d16, overlap + k * kLanes + x));
            return hn::Mul(hn::ConvertTo(d, hn::Sub(hn::Set(di, whole), same)),
                           hn::Set(d, static_cast<float>(factor)));
        };
        auto now = dAt(1);
        auto smoothed = now;
        for (int k = 1; k <= lastScale; ++k) {
            const auto next = dAt(k + 1);
            const auto sum = hn::Add(hn::Add(smoothed, now), next);
            smoothed = tables.smooth ? hn::Mul(sum, hn::Set(d, 1.0F / 3.0F)) : now;
            now = next;
            const double factor = tables.wFactor[static_cast<std::size_t>(tables.sMin + k)];
            hn::Store(hn::Mul(smoothed, hn::Set(d, static_cast<float>(factor * kRoundedUp))), d,
                      part.wBound.get() + k * kPart + x);
        }
    }
}

HWY_INLINE VFloats entropyOf(const TScaleTables& tables, const TPart& part, int k, int x) {
    const DFloat d;
    const DInt di;
    const hn::Rebind<std::uint16_t, DFloat> d16;
    const int area = tables.area[static_cast<std::size_t>(tables.sMin + k)];
    const CLogs logs(tables.bound[static_cast<std::size_t>(k)].log2Area);
    auto sum = hn::Zero(d);
    const std::uint16_t* count = part.countsOf(k) + x;
    for (int b = 0; b < part.present; ++b, count += kPart)
        sum = logs.addTo(sum, hn::PromoteTo(di, hn::Load(d16, count)));
    return hn::Mul(sum, hn::Set(d, -1.0F / static_cast<float>(area)));
}

/// Changes of the places from x on at scales 1..lastScale.
HWY_INLINE void computeChanges(const TScaleTables& tables, int x, int lastScale, TPart& part) {
    const DInt di;
    const hn::Rebind<std::uint16_t, DFloat> d16;
    for (int k = 1; k <= lastScale; ++k) {
        const auto s = static_cast<std::size_t>(tables.sMin + k);
        const auto area = hn::Set(di, tables.area[s]);
        const auto before = hn::Set(di, tables.area[s - 1]);
        auto change = hn::Zero(di);
        const std::uint16_t* count = part.countsOf(k) + x;
        for (int b = 0; b < part.present; ++b, count += kPart) {
            const auto n = hn::PromoteTo(di, hn::Load(d16, count));
            const auto old = hn::PromoteTo(di, hn::Load(d16, count - part.present * kPart));
            // r N' - n' R, with r = n - n' and R = N - N'
            change = hn::Add(
                change, hn::Max(hn::Sub(hn::Mul(n, before), hn::Mul(old, area)), hn::Zero(di)));
        }
        hn::Store(change, di, part.change.get() + k * kPart + x);
    }
}

template <class COUNT>
void searchAbove(const TScaleTables& tables,
                 const COUNT* rings,
                 const std::uint16_t* overlap,
                 int lastScale,
                 double yMin,
                 TPart& part) {
    const DFloat d;
    sumCounts(tables, rings, lastScale + 1, part);
    boundW(tables, overlap, lastScale, part);
    clearMarks(tables, part);
    for (int i = 0; i < kPart; ++i) part.place[i] = static_cast<std::uint8_t>(i);
    const auto least = hn::Set(d, static_cast<float>(yMin / tables.logTwo / kRoundedUp));
    const auto highest = hn::Set(d, static_cast<float>(std::log2(part.present)) + 1e-4F);
    for (int x = 0; x < kPart; x += kFloats) {
        const float* const w = part.wBound.get() + x;
        CMarks marks(x, part);
        int lastCandidate = 0;
        int entropiesTo = -1;  // scales whose entropies are known, of those last asked for
        for (int k = 1; k <= lastScale; ++k) {
            const auto wHere = hn::Load(d, w + k * kPart);
            if (hn::AllFalse(d, hn::Ge(hn::Mul(wHere, highest), least))) continue;
            float* const entropy = part.entropy.get() + k * kPart + x;
            for (int i = std::max(k - 1, entropiesTo + 1); i <= k + 1; ++i)
                hn::Store(entropyOf(tables, part, i, x), d, part.entropy.get() + i * kPart + x);
            entropiesTo = k + 1;
            const auto at = hn::Load(d, entropy);
            const auto salient = hn::Ge(hn::Mul(wHere, hn::Add(at, hn::Set(d, 1e-4F))), least);
            if (hn::AllFalse(d, salient)) continue;
            lastCandidate = k;
            marks.add(k, hn::Load(d, entropy - kPart), at, hn::Load(d, entropy + kPart), salient);
        }
        if (lastCandidate == 0) continue;
        computeChanges(tables, x, lastCandidate + 1, part);
        computeW(tables, x, kFloats, lastCandidate + 1, part);
    }
}

template <class COUNT>
TKernels<COUNT> kernels() {
    return {fill,      count<COUNT>,  countRest<COUNT>,  addOverlap<COUNT>,
            lastScale, search<COUNT>, searchAbove<COUNT>};
}

}  // namespace HWY_NAMESPACE
}  // namespace salma::saliency
#if HWY_TARGET == HWY_AVX3_DL
#pragma GCC pop_options
#endif
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace salma::saliency {

TPart::TPart(const TScaleTables& tables) {
    const auto n = static_cast<std::size_t>(tables.scales() * kPart);
    const auto words = static_cast<std::size_t>((tables.scales() + kInWord - 1) / kInWord * kPart);
    counts =
        hwy::AllocateAligned<std::uint16_t>((n + kPart) * static_cast<std::size_t>(tables.bins));
    change = hwy::AllocateAligned<std::int32_t>(n);
    entropy = hwy::AllocateAligned<float>(n);
    wBound = hwy::AllocateAligned<float>(n);
    w = hwy::AllocateAligned<double>(n);
    certain = hwy::AllocateAligned<std::uint32_t>(words);
    possible = hwy::AllocateAligned<std::uint32_t>(words);
}

namespace {

/// Highway's target of each of ours, widest first, if the compiler made it.
struct TTarget {
    ESimd simd;
    std::int64_t target;
};

constexpr TTarget kTargets[] = {{ESimd::avx512dl, HWY_AVX3_DL}, {ESimd::avx512, HWY_AVX3},
                                {ESimd::avx2, HWY_AVX2},        {ESimd::sse4, HWY_SSE4},
                                {ESimd::neon, HWY_NEON},        {ESimd::portable, HWY_EMU128}};

}  // namespace

bool hasSimd(ESimd simd) {
    std::int64_t supported = (hwy::SupportedTargets() | HWY_EMU128) & HWY_TARGETS;
#if HWY_TARGETS & HWY_AVX3_DL
    if (__builtin_cpu_supports("gfni") == 0) supported &= ~HWY_AVX3_DL;
#endif
    return std::any_of(std::begin(kTargets), std::end(kTargets), [&](const TTarget& t) {
        return t.simd == simd && (supported & t.target) != 0;
    });
}

ESimd bestSimd() {
    for (const auto& t : kTargets)
        if (hasSimd(t.simd)) return t.simd;
    return ESimd::portable;
}

template <class COUNT>
TKernels<COUNT> kernelsFor(ESimd simd) {
    if (simd == ESimd::automatic) simd = bestSimd();
    if (!hasSimd(simd))
        throw std::invalid_argument(
            "scale saliency: this processor, or this build, has not got the "
            "instruction set of the option simd; auto takes the best there is");
#if HWY_TARGETS & HWY_AVX3_DL
    if (simd == ESimd::avx512dl) return N_AVX3_DL::kernels<COUNT>();
#endif
#if HWY_TARGETS & HWY_AVX3
    if (simd == ESimd::avx512) return N_AVX3::kernels<COUNT>();
#endif
#if HWY_TARGETS & HWY_AVX2
    if (simd == ESimd::avx2) return N_AVX2::kernels<COUNT>();
#endif
#if HWY_TARGETS & HWY_SSE4
    if (simd == ESimd::sse4) return N_SSE4::kernels<COUNT>();
#endif
#if HWY_TARGETS & HWY_NEON
    if (simd == ESimd::neon) return N_NEON::kernels<COUNT>();
#endif
    return N_EMU128::kernels<COUNT>();
}

template TKernels<std::uint8_t> kernelsFor(ESimd simd);
template TKernels<std::uint16_t> kernelsFor(ESimd simd);

}  // namespace salma::saliency
#endif
