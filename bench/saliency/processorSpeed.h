// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>

#include <functional>

namespace salma::bench {

/** Loops of known work, to be timed: `run` does `operations` of them one after the other, or as
 * many at once as the processor can. */
struct TSpeedLoop {
    std::function<void()> run;
    double operations{0};
};

/// Additions that each wait for the one before: one a cycle.
TSpeedLoop dependentAdditions();

/// Exclusive ors of whole vectors in registers, independent of each other.
TSpeedLoop simpleOperations(saliency::ESimd simd);

/// Multiply-adds of whole vectors of floats in registers, independent of each other.
TSpeedLoop multiplyAdds(saliency::ESimd simd);

/// Loads of whole vectors from the first-level cache, each one 64-bit word further, as ring pixels
/// of a bitmap are.
TSpeedLoop unalignedLoads(saliency::ESimd simd);

/// Bits of a vector; 0 for the portable set, which has none.
int vectorBits(saliency::ESimd simd);

}  // namespace salma::bench
