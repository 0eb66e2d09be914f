// SPDX-License-Identifier: BSD-3-Clause
#include "ringKernels.h"

#include <algorithm>
#include <cstring>

#include "simdTargets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ringKernels.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
#if HWY_TARGET == HWY_AVX3_DL
#pragma GCC push_options
#pragma GCC target("gfni")  // Highway 1.0 leaves it out
#endif
namespace salma::saliency {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::CappedTag<std::uint16_t, kLanes>;
constexpr int kShorts = static_cast<int>(hn::MaxLanes(D16()));

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
HWY_NOINLINE void countRing(const std::int32_t* first,
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
HWY_NOINLINE void countRing(const std::int32_t* first,
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

TRingKernels<std::uint8_t> byteKernels() {
    return {fill, count<std::uint8_t>, countRest<std::uint8_t>};
}

TRingKernels<std::uint16_t> wordKernels() {
    return {fill, count<std::uint16_t>, countRest<std::uint16_t>};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace salma::saliency
#if HWY_TARGET == HWY_AVX3_DL
#pragma GCC pop_options
#endif
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace salma::saliency {

template <>
TRingKernels<std::uint8_t> ringKernels(ESimd simd) {
    return SALMA_MADE_FOR(simd, TRingKernels<std::uint8_t>(*)(), byteKernels)();
}

template <>
TRingKernels<std::uint16_t> ringKernels(ESimd simd) {
    return SALMA_MADE_FOR(simd, TRingKernels<std::uint16_t>(*)(), wordKernels)();
}

}  // namespace salma::saliency
#endif
