// SPDX-License-Identifier: BSD-3-Clause
#include "processorSpeed.h"

#include <array>
#include <cstdint>
#include <stdexcept>

// The instruction sets of scaleKernels.cpp; the portable one has no vectors to be timed.
#define HWY_COMPILE_ALL_ATTAINABLE
#define HWY_BROKEN_EMU128 0
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "processorSpeed.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

// Makes the compiler believe that a vector's value is changed, so that it leaves out no operation.
#undef SALMA_KEEP
#if HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SCALAR
#define SALMA_KEEP(v) asm volatile("" : "+m"(v))
#elif HWY_ARCH_X86
#define SALMA_KEEP(v) asm volatile("" : "+x"((v).raw))
#else
#define SALMA_KEEP(v) asm volatile("" : "+w"((v).raw))
#endif

HWY_BEFORE_NAMESPACE();
namespace salma::bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kRounds = 20000;
constexpr int kChains = 8;  // at least latency times throughput

/// Variables of their own, as the compiler keeps an array of vectors in memory.
template <class D, class OPERATION>
HWY_INLINE void runChains(D d, OPERATION operation) {
    static_assert(kChains == 8, "as many as there are here");
    auto c0 = hn::Zero(d), c1 = c0, c2 = c0, c3 = c0, c4 = c0, c5 = c0, c6 = c0, c7 = c0;
    const auto step = [&operation](auto& c) HWY_ATTR {
        c = operation(c);
        SALMA_KEEP(c);
    };
    for (int i = 0; i < kRounds; ++i) {
        step(c0);
        step(c1);
        step(c2);
        step(c3);
        step(c4);
        step(c5);
        step(c6);
        step(c7);
    }
}

void exclusiveOrs() {
    const hn::ScalableTag<std::uint64_t> d;
    auto other = hn::Set(d, 3);
    SALMA_KEEP(other);
    runChains(d, [&](auto c) HWY_ATTR { return hn::Xor(c, other); });
}

void multiplyAdds() {
    const hn::ScalableTag<float> d;
    auto other = hn::Set(d, 0.5F);
    SALMA_KEEP(other);
    runChains(d, [&](auto c) HWY_ATTR { return hn::MulAdd(c, other, other); });
}

void loads() {
    const hn::ScalableTag<std::uint64_t> d;
    HWY_ALIGN std::array<std::uint64_t, 1024> words{};
    for (std::size_t i = 0; i < kRounds; ++i)
        for (std::size_t j = 0; j < kChains; ++j) {
            auto v = hn::LoadU(d, &words[i % 64 * kChains + j]);
            SALMA_KEEP(v);
        }
}

}  // namespace HWY_NAMESPACE
}  // namespace salma::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace salma::bench {
namespace {

using saliency::ESimd;

constexpr double kOperations = 20000.0 * 8;

struct TLoops {
    int bits;
    void (*exclusiveOrs)();
    void (*multiplyAdds)();
    void (*loads)();
};

TLoops loopsOf(ESimd simd) {
    if (simd == ESimd::automatic) simd = saliency::bestSimd();
    if (simd == ESimd::avx512dl) simd = ESimd::avx512;  // the same vectors
#if HWY_TARGETS & HWY_AVX3
    if (simd == ESimd::avx512)
        return {512, N_AVX3::exclusiveOrs, N_AVX3::multiplyAdds, N_AVX3::loads};
#endif
#if HWY_TARGETS & HWY_AVX2
    if (simd == ESimd::avx2)
        return {256, N_AVX2::exclusiveOrs, N_AVX2::multiplyAdds, N_AVX2::loads};
#endif
#if HWY_TARGETS & HWY_SSE4
    if (simd == ESimd::sse4)
        return {128, N_SSE4::exclusiveOrs, N_SSE4::multiplyAdds, N_SSE4::loads};
#endif
#if HWY_TARGETS & HWY_NEON
    if (simd == ESimd::neon)
        return {128, N_NEON::exclusiveOrs, N_NEON::multiplyAdds, N_NEON::loads};
#endif
    throw std::invalid_argument("no vectors to be timed");
}

}  // namespace

TSpeedLoop dependentAdditions() {
    constexpr int kSteps = 100000;
    constexpr int kUnrolled = 16;
    const auto run = [] {
        std::uint64_t sum = 0;
        std::uint64_t one = 1;
        asm volatile("" : "+r"(one));  // a constant would be added while renaming registers
        for (int i = 0; i < kSteps; ++i)
#pragma GCC unroll 16
            for (int j = 0; j < kUnrolled; ++j) {
                sum += one;
                asm volatile("" : "+r"(sum));
            }
    };
    return {run, double(kSteps) * kUnrolled};
}

TSpeedLoop simpleOperations(ESimd simd) { return {loopsOf(simd).exclusiveOrs, kOperations}; }

TSpeedLoop multiplyAdds(ESimd simd) { return {loopsOf(simd).multiplyAdds, kOperations}; }

TSpeedLoop unalignedLoads(ESimd simd) { return {loopsOf(simd).loads, kOperations}; }

int vectorBits(ESimd simd) { return simd == ESimd::portable ? 0 : loopsOf(simd).bits; }

}  // namespace salma::bench
#endif
