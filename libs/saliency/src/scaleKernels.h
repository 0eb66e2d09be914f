// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TScaleTables.h"

namespace salma::saliency {

/** Prefix sums of one bin's indicator over a tile, all modulo the range of COUNT; three arrays
 * [(rows+1) x stride]. Entry (r, c) sums over pixels before it: */
template <class COUNT>
struct TPlanes {
    const COUNT* alongRow{nullptr};     //!< of row r, columns < c;
    const COUNT* alongColumn{nullptr};  //!< of column c, rows < r;
    const COUNT* square{nullptr};       //!< rows < r and columns < c.
    int stride{0};
};

/** The inner loops. The same source is compiled once for each instruction set; all arithmetic in
 * it is on integers, so that every set gives the same result. */
template <class COUNT>
struct TKernels {
    /** How many pixels of a bin lie in disc(s), s = sMin..sMax, modulo the range of COUNT, for
     * kLanes centres in tile row `row`, of which the first is in tile column sMax.
     * \param scratch [3 * (sMax+1) * stride] \param out [scales x kLanes] */
    void (*discs)(const TScaleTables& tables,
                  const TPlanes<COUNT>& planes,
                  int row,
                  COUNT* scratch,
                  COUNT* out);

    /** Turns the result of `discs` into counts, and adds max(0, r N' - n' R) of each scale (r of
     * R ring pixels and n' of N' pixels of the disc before are in the bin) to `change`.
     * \param counts [scales] rows of kLanes, `stride` apart \param change [scales x kLanes] */
    void (*accumulate)(const TScaleTables& tables,
                       const COUNT* discs,
                       std::uint16_t* counts,
                       int stride,
                       std::int32_t* change);
};

template <class COUNT>
TKernels<COUNT> kernelsFor(ESimd simd);

}  // namespace salma::saliency
