// SPDX-License-Identifier: BSD-3-Clause
// Which instruction sets Highway compiles inner loops for; included before anything of Highway.
#pragma once

#include <salma/saliency/CScaleSaliency.h>

#include <initializer_list>
#include <utility>

// Every one that the compiler knows, the portable one included; others would add nothing (SSSE3) or
// have vectors whose size is known too late (SVE).
#define HWY_COMPILE_ALL_ATTAINABLE
#define HWY_WANT_AVX3_DL
#define HWY_BROKEN_EMU128 0  // the portable one; tests show that g++ 12.2 does it no harm here
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)

namespace salma::saliency {

/// \throw std::invalid_argument if this processor, or this build, has not got `simd`.
ESimd availableSimd(ESimd simd);

/// The function made for an instruction set. \throw std::invalid_argument as availableSimd.
template <class FUNCTION>
FUNCTION madeFor(ESimd simd, std::initializer_list<std::pair<ESimd, FUNCTION>> functions) {
    const ESimd available = availableSimd(simd);
    FUNCTION made = nullptr;
    for (const auto& [target, function] : functions)
        if (target == available) made = function;
    return made;
}

}  // namespace salma::saliency

/// Pointer to the `name` of HWY_NAMESPACE for an instruction set; FUNCTION is its type.
#define SALMA_MADE_FOR(simd, FUNCTION, name)                                   \
    ::salma::saliency::madeFor<FUNCTION>(                                      \
        simd, {{::salma::saliency::ESimd::avx512dl, HWY_CHOOSE_AVX3_DL(name)}, \
               {::salma::saliency::ESimd::avx512, HWY_CHOOSE_AVX3(name)},      \
               {::salma::saliency::ESimd::avx2, HWY_CHOOSE_AVX2(name)},        \
               {::salma::saliency::ESimd::sse4, HWY_CHOOSE_SSE4(name)},        \
               {::salma::saliency::ESimd::neon, HWY_CHOOSE_NEON(name)},        \
               {::salma::saliency::ESimd::portable, HWY_CHOOSE_FALLBACK(name)}})
