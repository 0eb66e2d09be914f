// SPDX-License-Identifier: BSD-3-Clause
#include "scaleKernels.h"

#include <algorithm>
#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__)
#define SALMA_X86 1
#endif

namespace salma::saliency {
namespace {

// Forced inlining compiles these anew inside of each function that has a target attribute.
#define SALMA_INLINE [[gnu::always_inline]] inline

template <class COUNT>
SALMA_INLINE void add(COUNT* __restrict sum, const COUNT* a, const COUNT* b, int n) {
    for (int x = 0; x < n; ++x) sum[x] = static_cast<COUNT>(a[x] + b[x]);
}

template <class COUNT>
SALMA_INLINE void subtract(COUNT* __restrict out, const COUNT* a, const COUNT* b, int n) {
    for (int x = 0; x < n; ++x) out[x] = static_cast<COUNT>(a[x] - b[x]);
}

/// kLanes counts in registers of WIDTH bytes each, as the compilers' vector types.
template <class COUNT, int WIDTH>
struct TRegisters {
    typedef COUNT TVector __attribute__((vector_size(WIDTH)));
    static constexpr int kEach = WIDTH / static_cast<int>(sizeof(COUNT));
    static constexpr int kCount = kLanes / kEach;
    TVector v[kCount];

    SALMA_INLINE void set(const COUNT* from) { std::memcpy(v, from, sizeof v); }
    SALMA_INLINE void add(const COUNT* from) {
        for (int i = 0; i < kCount; ++i) {
            TVector other;
            std::memcpy(&other, from + i * kEach, sizeof other);
            v[i] += other;
        }
    }
    SALMA_INLINE void subtract(const COUNT* from) {
        for (int i = 0; i < kCount; ++i) {
            TVector other;
            std::memcpy(&other, from + i * kEach, sizeof other);
            v[i] -= other;
        }
    }
    SALMA_INLINE void store(COUNT* to) const { std::memcpy(to, v, sizeof v); }
};

/** The sums from which discsImpl puts discs together, for the centres of one row y. */
template <class COUNT>
struct TRowSums {
    COUNT* rowPairs;  //!< Of row j: rows y+j and y-j.
    COUNT* columns;   //!< Of h: rows y-h..y+h.
    COUNT* squares;   //!< Of m: rows y-m..y+m.
};

template <class COUNT>
SALMA_INLINE void sumRows(const TScaleTables& tables,
                          const TPlanes<COUNT>& planes,
                          int row,
                          const TRowSums<COUNT>& sums) {
    const int stride = planes.stride;
    const int smallest = tables.innerSquare[static_cast<std::size_t>(tables.sMin)];
    for (int j = smallest + 1; j <= tables.sMax; ++j)
        add(sums.rowPairs + j * stride, planes.alongRow + (row + j) * stride,
            planes.alongRow + (row - j) * stride, stride);
    for (int h = 0; h <= tables.innerSquare.back(); ++h) {
        const int below = (row + h + 1) * stride;
        const int above = (row - h) * stride;
        subtract(sums.columns + h * stride, planes.alongColumn + below, planes.alongColumn + above,
                 stride);
        subtract(sums.squares + h * stride, planes.square + below, planes.square + above, stride);
    }
}

template <class COUNT, int WIDTH>
SALMA_INLINE void discsImpl(
    const TScaleTables& tables, const TPlanes<COUNT>& planes, int row, COUNT* scratch, COUNT* out) {
    const int stride = planes.stride;
    const int third = (tables.sMax + 1) * stride;
    const TRowSums<COUNT> sums{scratch, scratch + third, scratch + 2 * third};
    sumRows(tables, planes, row, sums);
    for (int s = tables.sMin; s <= tables.sMax; ++s, out += kLanes) {
        const int m = tables.innerSquare[static_cast<std::size_t>(s)];
        const COUNT* const square = sums.squares + m * stride + tables.sMax;
        TRegisters<COUNT, WIDTH> disc;
        disc.set(square + m + 1);
        disc.subtract(square - m);
        for (const auto& outer : tables.outerRows[static_cast<std::size_t>(s)]) {
            const COUNT* const pair = sums.rowPairs + outer.j * stride + tables.sMax;
            const COUNT* const column = sums.columns + outer.half * stride + tables.sMax;
            disc.add(pair + outer.half + 1);
            disc.subtract(pair - outer.half);
            disc.add(column + outer.j);
            disc.add(column - outer.j);
        }
        disc.store(out);
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
template <class COUNT>
void discsBaseline(
    const TScaleTables& tables, const TPlanes<COUNT>& planes, int row, COUNT* scratch, COUNT* out) {
    discsImpl<COUNT, 16>(tables, planes, row, scratch, out);
}

template <class COUNT>
void accumulateBaseline(const TScaleTables& tables,
                        const COUNT* discs,
                        std::uint16_t* counts,
                        int stride,
                        std::int32_t* change) {
    accumulateImpl(tables, discs, counts, stride, change);
}

#ifdef SALMA_X86
template <class COUNT>
[[gnu::target("avx2")]] void discsAvx2(
    const TScaleTables& tables, const TPlanes<COUNT>& planes, int row, COUNT* scratch, COUNT* out) {
    discsImpl<COUNT, 32>(tables, planes, row, scratch, out);
}

template <class COUNT>
[[gnu::target("avx2")]] void accumulateAvx2(const TScaleTables& tables,
                                            const COUNT* discs,
                                            std::uint16_t* counts,
                                            int stride,
                                            std::int32_t* change) {
    accumulateImpl(tables, discs, counts, stride, change);
}

template <class COUNT>
[[gnu::target("avx512bw,avx512vl,prefer-vector-width=512")]] void discsAvx512(
    const TScaleTables& tables, const TPlanes<COUNT>& planes, int row, COUNT* scratch, COUNT* out) {
    discsImpl<COUNT, 64>(tables, planes, row, scratch, out);
}

template <class COUNT>
[[gnu::target("avx512bw,avx512vl,prefer-vector-width=512")]] void accumulateAvx512(
    const TScaleTables& tables,
    const COUNT* discs,
    std::uint16_t* counts,
    int stride,
    std::int32_t* change) {
    accumulateImpl(tables, discs, counts, stride, change);
}
#endif

}  // namespace

ESimd bestSimd() {
#ifdef SALMA_X86
    if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        return ESimd::avx512;
    if (__builtin_cpu_supports("avx2")) return ESimd::avx2;
#endif
    return ESimd::baseline;
}

template <class COUNT>
TKernels<COUNT> kernelsFor(ESimd simd) {
#ifdef SALMA_X86
    const ESimd usable = std::min(simd, bestSimd());
    if (usable == ESimd::avx512) return {discsAvx512<COUNT>, accumulateAvx512<COUNT>};
    if (usable == ESimd::avx2) return {discsAvx2<COUNT>, accumulateAvx2<COUNT>};
#else
    static_cast<void>(simd);
#endif
    return {discsBaseline<COUNT>, accumulateBaseline<COUNT>};
}

template TKernels<std::uint8_t> kernelsFor(ESimd simd);
template TKernels<std::uint16_t> kernelsFor(ESimd simd);

}  // namespace salma::saliency
