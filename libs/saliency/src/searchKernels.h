// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hwy/aligned_allocator.h>

#include <array>

#include "TScaleTables.h"

namespace salma::saliency {

constexpr int kPart = 32;    // centres searched together, so that their counts fit into a cache
constexpr int kInWord = 32;  // scales whose marks share a word

/// What is known of kPart centres of a row. Places are those of the centres in another order.
struct TPart {
    explicit TPart(const TScaleTables& tables);

    template <class T>
    using TBuffer = hwy::AlignedFreeUniquePtr<T[]>;
    int present{0};  //!< Bins that are counted.
    /// Pixels of the disc at scale k in each bin, [present][centre]; k = -1 has none.
    std::uint16_t* countsOf(int k) const { return counts.get() + (k + 1) * present * kPart; }

    TBuffer<std::uint16_t> counts;    //!< Of scales -1, 0, ...
    TBuffer<std::int32_t> change;     //!< [scale][place] sum max(0, r N' - n' R).
    TBuffer<float> entropy;           //!< [scale][place] about H [bit].
    TBuffer<float> wBound;            //!< [scale][place] at least W.
    TBuffer<double> w;                //!< [scale][place] W.
    std::vector<int> firstScale;      //!< At which a bin occurs about the centres, ascending.
    std::vector<int> order;           //!< The bins in that order.
    TBuffer<std::uint32_t> certain;   //!< [word][place] bit s: a peak of entropy at scale s.
    TBuffer<std::uint32_t> possible;  //!< [word][place] bit s: a peak, or too close to tell.
    std::array<std::uint8_t, kPart> place{};  //!< Of each centre.
};

/** The inner loops that turn counts of ring pixels into marks of peaks. The same source is compiled
 * once for each instruction set. What is reported or decides comes from integers and from doubles
 * in one order of operations, so that every set gives the same peaks; floats only say what needs no
 * closer look. */
template <class COUNT>
struct TSearchKernels {
    /** Adds what a bin has in common between ring and disc before, rounded down.
     * \param rings Result of `count`. \param overlap [row][scale][lane] */
    void (*addOverlap)(const TScaleTables& tables,
                       const COUNT* rings,
                       int scales,
                       std::size_t stride,
                       std::uint16_t* overlap){nullptr};

    /** The largest scale at which a centre can have D >= atLeast, if other bins added nothing to
     * the overlaps; 0 if there is none.
     * \param overlap Of one row, [scale][lane], up to `scales`. \param count Centres. */
    int (*lastScale)(const TScaleTables& tables,
                     const std::uint16_t* overlap,
                     int scales,
                     int count,
                     const std::uint16_t* atLeast){nullptr};

    /** Marks the peaks of a part's entropies, and computes its W.
     * \param rings Result of `count` for the part's first centre, [present][scale][lane]. */
    void (*search)(const TScaleTables& tables, const COUNT* rings, TPart& part){nullptr};

    /** As `search`, but leaves out what cannot be a peak with Y >= yMin.
     * \param overlap Of all bins, [scale][lane] for the part's first centre.
     * \param lastScale Scales above cannot have one; rings and overlaps are known to the next. */
    void (*searchAbove)(const TScaleTables& tables,
                        const COUNT* rings,
                        const std::uint16_t* overlap,
                        int lastScale,
                        double yMin,
                        TPart& part){nullptr};
};

/// \throw std::invalid_argument if this processor or this program has not got `simd`.
template <class COUNT>
TSearchKernels<COUNT> searchKernels(ESimd simd);

}  // namespace salma::saliency
