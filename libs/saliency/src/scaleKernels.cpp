// SPDX-License-Identifier: BSD-3-Clause
#include "scaleKernels.h"

#include <algorithm>

#if defined(__x86_64__) && defined(__GNUC__)
#define SALMA_X86 1
#endif

namespace salma::saliency {
namespace {

// Forced inlining compiles these anew inside of each function that has a target attribute.
#define SALMA_INLINE [[gnu::always_inline]] inline

template <class COUNT>
SALMA_INLINE void add(COUNT* sum, const COUNT* a, const COUNT* b, int n) {
    for (int x = 0; x < n; ++x) sum[x] = static_cast<COUNT>(a[x] + b[x]);
}

template <class COUNT>
SALMA_INLINE void subtract(COUNT* __restrict out, const COUNT* a, const COUNT* b, int n) {
    for (int x = 0; x < n; ++x) out[x] = static_cast<COUNT>(a[x] - b[x]);
}

template <class COUNT>
SALMA_INLINE void discsImpl(
    const TScaleTables& tables, const TPlanes<COUNT>& planes, int row, COUNT* scratch, COUNT* out) {
    const int stride = planes.stride;
    const int largest = tables.innerSquare.back();
    const int smallest = tables.innerSquare[static_cast<std::size_t>(tables.sMin)];
    COUNT* const rowPairs = scratch;                               // of row j: rows y+j and y-j
    COUNT* const columns = rowPairs + (tables.sMax + 1) * stride;  // of h: rows y-h..y+h
    COUNT* const squares = columns + (tables.sMax + 1) * stride;   // of m: rows y-m..y+m
    for (int j = smallest + 1; j <= tables.sMax; ++j)
        add(rowPairs + j * stride, planes.alongRow + (row + j) * stride,
            planes.alongRow + (row - j) * stride, stride);
    for (int h = 0; h <= largest; ++h) {
        const int below = (row + h + 1) * stride;
        const int above = (row - h) * stride;
        subtract(columns + h * stride, planes.alongColumn + below, planes.alongColumn + above,
                 stride);
        subtract(squares + h * stride, planes.square + below, planes.square + above, stride);
    }
    for (int s = tables.sMin; s <= tables.sMax; ++s, out += kLanes) {
        const int m = tables.innerSquare[static_cast<std::size_t>(s)];
        const COUNT* const square = squares + m * stride + tables.sMax;
        COUNT sum[kLanes];
        subtract(sum, square + m + 1, square - m, kLanes);
        for (const auto& outer : tables.outerRows[static_cast<std::size_t>(s)]) {
            const COUNT* const pair = rowPairs + outer.j * stride + tables.sMax;
            const COUNT* const column = columns + outer.half * stride + tables.sMax;
            const COUNT* const right = pair + outer.half + 1;
            const COUNT* const left = pair - outer.half;
            for (int x = 0; x < kLanes; ++x)
                sum[x] = static_cast<COUNT>(sum[x] + right[x] - left[x] + column[x + outer.j] +
                                            column[x - outer.j]);
        }
        std::copy(sum, sum + kLanes, out);
    }
}

template <class COUNT>
SALMA_INLINE void accumulateImpl(const TScaleTables& tables,
                                 const COUNT* __restrict discs,
                                 std::uint16_t* __restrict counts,
                                 int stride,
                                 std::int32_t* __restrict change) {
    for (int x = 0; x < kLanes; ++x) counts[x] = discs[x];
    for (int s = tables.sMin + 1; s <= tables.sMax; ++s) {
        const int before = tables.area[static_cast<std::size_t>(s) - 1];
        const int inRing = tables.area[static_cast<std::size_t>(s)] - before;
        const std::uint16_t* const previous = counts;
        discs += kLanes;
        counts += stride;
        change += kLanes;
        for (int x = 0; x < kLanes; ++x) {
            const auto ring = static_cast<COUNT>(discs[x] - discs[x - kLanes]);
            const std::int32_t growth = ring * before - previous[x] * inRing;
            counts[x] = static_cast<std::uint16_t>(previous[x] + ring);
            change[x] += growth > 0 ? growth : 0;
        }
    }
}

// One pair of functions for each instruction set.
#define SALMA_KERNELS(NAME, ATTRIBUTE)                                                       \
    template <class COUNT>                                                                   \
    ATTRIBUTE void discs##NAME(const TScaleTables& tables, const TPlanes<COUNT>& p, int row, \
                               COUNT* scratch, COUNT* out) {                                 \
        discsImpl(tables, p, row, scratch, out);                                             \
    }                                                                                        \
    template <class COUNT>                                                                   \
    ATTRIBUTE void accumulate##NAME(const TScaleTables& t, const COUNT* discs,               \
                                    std::uint16_t* counts, int stride, std::int32_t* sums) { \
        accumulateImpl(t, discs, counts, stride, sums);                                      \
    }

SALMA_KERNELS(Baseline, )
#ifdef SALMA_X86
SALMA_KERNELS(Avx2, [[gnu::target("avx2")]])
SALMA_KERNELS(Avx512, [[gnu::target("avx512bw,avx512vl,prefer-vector-width=512")]])
#endif

}  // namespace

TSimd bestSimd() {
#ifdef SALMA_X86
    if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        return TSimd::AVX512;
    if (__builtin_cpu_supports("avx2")) return TSimd::AVX2;
#endif
    return TSimd::Baseline;
}

template <class COUNT>
TKernels<COUNT> kernelsFor(TSimd simd) {
#ifdef SALMA_X86
    const TSimd usable = std::min(simd, bestSimd());
    if (usable == TSimd::AVX512) return {discsAvx512<COUNT>, accumulateAvx512<COUNT>};
    if (usable == TSimd::AVX2) return {discsAvx2<COUNT>, accumulateAvx2<COUNT>};
#else
    static_cast<void>(simd);
#endif
    return {discsBaseline<COUNT>, accumulateBaseline<COUNT>};
}

template TKernels<std::uint8_t> kernelsFor(TSimd simd);
template TKernels<std::uint16_t> kernelsFor(TSimd simd);

}  // namespace salma::saliency
