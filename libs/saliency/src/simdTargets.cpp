// SPDX-License-Identifier: BSD-3-Clause
#include "simdTargets.h"

#include <hwy/highway.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace salma::saliency {
namespace {

/// Highway's target of each of ours, widest first.
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
    if (__builtin_cpu_supports("gfni") == 0) supported &= ~HWY_AVX3_DL;  // Highway does not ask
#endif
    return std::any_of(std::begin(kTargets), std::end(kTargets), [&](const TTarget& t) {
        return t.simd == simd && (supported & t.target) != 0;
    });
}

ESimd bestSimd() {
    const auto best = std::find_if(std::begin(kTargets), std::end(kTargets),
                                   [](const TTarget& t) { return hasSimd(t.simd); });
    return best->simd;  // the portable one is always there
}

ESimd availableSimd(ESimd simd) {
    if (simd == ESimd::automatic) return bestSimd();
    if (!hasSimd(simd))
        throw std::invalid_argument(
            "scale saliency: this processor, or this build, has not got the instruction set of "
            "the option simd; auto takes the best there is");
    return simd;
}

}  // namespace salma::saliency
