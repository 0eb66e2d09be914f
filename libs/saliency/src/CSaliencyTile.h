// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "scaleKernels.h"

namespace salma::saliency {

/// A peak of a row of centres; its Y is H W.
struct TPeak {
    std::uint16_t column{0};  //!< Centre [px].
    std::uint16_t scale{0};   //!< Radius [px].
    double H{0};
    double W{0};
};

/** Finds the peaks of up to kLanes x kTileRows centres; its buffers serve one tile after another.
 * One per thread. */
template <class COUNT>
class CSaliencyTile {
 public:
    using TPeaks = std::vector<TPeak>;

    CSaliencyTile(const TScaleTables& tables, const TKernels<COUNT>& kernels);

    /** \param bins The picture's cells of the histogram, CV_8UC1.
     * \param centres Which pixels are centres; at least sMax from each border.
     * \param rows One list for each row of centres, to which its peaks are added by column, scale.
     */
    void detect(const cv::Mat& bins, const cv::Rect& centres, double yMin, TPeaks* rows);

 private:
    void fillBitmaps(const cv::Mat& window);
    /// Bins with a pixel in the discs of the centres of `count` rows from `row`.
    void findPresent(int row, int count);
    void detectBand(const cv::Rect& centres, int row, TPeaks* rows);
    void countBand(int row);
    /// Peaks of the centres x..x+kPart-1 of a row of the band, of which `count` exist.
    void searchPart(int bandRow, int x);
    void emitPeaks(int firstColumn, int count, TPeaks& found) const;
    bool isPeak(int k, int x) const;
    double entropy(int k, int x) const;

    const TScaleTables& m_tables;
    TKernels<COUNT> m_kernels;
    int m_scales;
    double m_yMin{0};
    std::size_t m_ofBin;  //!< Counts of a bin in a row of centres.

    std::vector<hwy::AlignedFreeUniquePtr<std::uint64_t[]>> m_bitmaps;  //!< Of each bin.
    std::vector<std::vector<std::uint8_t>> m_inRow;  //!< [bin][row] whether it occurs there.
    std::vector<std::size_t> m_present;              //!< Bins, ascending.
    hwy::AlignedFreeUniquePtr<COUNT[]> m_rings;      //!< [band row][present][scale][lane]
    std::size_t m_ringsSize{0};
    TPart m_part;
};

}  // namespace salma::saliency
