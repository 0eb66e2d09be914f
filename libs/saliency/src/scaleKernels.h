// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hwy/aligned_allocator.h>

#include <array>

#include "TScaleTables.h"

namespace salma::saliency {

constexpr int kPart = 32;    // centres searched together, so that their counts fit into a cache
constexpr int kInWord = 32;  // scales whose marks share a word

/** Prefix sums of one bin's indicator over a tile, all modulo the range of COUNT; three arrays of
 * rows `stride` apart. Entry (r, c) sums over pixels before it: */
template <class COUNT>
struct TPlanes {
    const COUNT* alongRow{nullptr};     //!< of row r, columns < c;
    const COUNT* alongColumn{nullptr};  //!< of column c, rows < r;
    const COUNT* square{nullptr};       //!< rows < r and columns < c.
};

/// What is known of kPart centres of a row. Places are those of the centres in another order.
struct TPart {
    TPart(const TScaleTables& tables);
    void setPresent(int bins);

    template <class T>
    using TBuffer = hwy::AlignedFreeUniquePtr<T[]>;
    int present{0};                 //!< Bins that are counted.
    TBuffer<std::uint16_t> counts;  //!< [scale][present][centre] pixels of the disc in the bin.
    TBuffer<std::uint16_t> bound;   //!< [scale][centre] at least the change of the histogram.
    TBuffer<std::int32_t> change;   //!< [scale][place] sum max(0, r N' - n' R).
    TBuffer<float> entropy;         //!< [scale][place] about H [bit].
    TBuffer<float> wBound;          //!< [scale][place] at least W.
    TBuffer<double> w;              //!< [scale][place] W.
    TBuffer<std::uint32_t> certain;   //!< [word][place] bit s: a peak of entropy at scale s.
    TBuffer<std::uint32_t> possible;  //!< [word][place] bit s: a peak, or too close to tell.
    std::array<std::uint8_t, kPart> place{};  //!< Of each centre.
};

/** The inner loops. The same source is compiled once for each instruction set. What is reported or
 * decides comes from integers and from doubles in one order of operations, so that every set gives
 * the same peaks; floats only say what needs no closer look. */
template <class COUNT>
struct TKernels {
    /** How many pixels of a bin lie in disc(s), s = sMin..sMax, modulo the range of COUNT, for
     * kLanes centres in tile row `row`, of which the first is in column plan.origin.
     * \param scratch [plan.scratchSize] \param out [scales x kLanes] */
    void (*discs)(const TScaleTables& tables,
                  const TPlanes<COUNT>& planes,
                  int row,
                  COUNT* scratch,
                  COUNT* out){nullptr};

    /** Marks the peaks of a part's entropies, and computes its W.
     * \param discs Result of `discs` for the part's first centre, [present][scale] rows of kLanes */
    void (*search)(const TScaleTables& tables, const COUNT* discs, TPart& part){nullptr};

    /// As `search`, but leaves out what cannot be a peak with Y >= yMin.
    void (*searchAbove)(const TScaleTables& tables,
                        const COUNT* discs,
                        double yMin,
                        TPart& part){nullptr};
};

/// \throw std::invalid_argument if this processor or this program has not got `simd`.
template <class COUNT>
TKernels<COUNT> kernelsFor(ESimd simd);

}  // namespace salma::saliency
