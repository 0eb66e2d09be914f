// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "TScaleTables.h"

namespace salma::saliency {

/** The inner loops that count ring pixels. The same source is compiled once for each instruction
 * set. COUNT is std::uint8_t, or std::uint16_t where a ring can have more pixels. */
template <class COUNT>
struct TRingKernels {
    /** Writes the bitmap of one bin.
     * \param bins First pixel of the window; the window has [height x width] pixels, height at
     * most kTileRows + 2 reach, width at most kLanes + 2 reach.
     * \param perRow [height] how many pixels of a row are in the bin. */
    void (*fill)(const TBitmapLayout& layout,
                 const cv::Mat& window,
                 std::uint8_t bin,
                 std::uint64_t* bitmap,
                 std::uint16_t* perRow){nullptr};

    /** How many pixels of a bin lie in each ring about the kLanes centres of kBandRows rows.
     * \param bitmap The bin's, from the band's first row on.
     * \param rows Of the window, from the band's first on, that have pixels of the bin.
     * \param scales How many, from the smallest.
     * \param out [row][scale][lane], rows `stride` apart. */
    void (*count)(const TScaleTables& tables,
                  const std::uint64_t* bitmap,
                  const cv::Range& rows,
                  int scales,
                  std::size_t stride,
                  COUNT* out){nullptr};

    /// Counts the bin `which` from the other ones. \param rings Of a row, [present][scale][lane].
    void (*countRest)(const TScaleTables& tables, int present, int which, COUNT* rings){nullptr};
};

/// \throw std::invalid_argument if this processor or this program has not got `simd`.
template <class COUNT>
TRingKernels<COUNT> ringKernels(ESimd simd);

}  // namespace salma::saliency
