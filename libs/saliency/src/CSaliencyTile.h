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
    /// Counts a bin in the band that begins with `row`, up to a number of scales.
    void countBin(std::size_t present, int row, int scales);
    /** Counts bins, the most frequent first, only as long and as far as there can be a peak.
     * \return The last scale that can have one, for each row and part; 0 if none can. */
    void countNeeded(const cv::Size& centres, int row);
    std::vector<std::uint16_t> leastChanges() const;
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
    std::vector<std::vector<std::uint16_t>> m_perRow;  //!< [bin][row] pixels.
    std::vector<std::size_t> m_present;              //!< Bins, ascending.
    hwy::AlignedFreeUniquePtr<COUNT[]> m_rings;      //!< [band row][present][scale][lane]
    std::size_t m_ringsSize{0};
    hwy::AlignedFreeUniquePtr<std::uint16_t[]> m_overlap;  //!< [band row][scale][lane]
    int m_lastScales[kBandRows][kLanes / kPart]{};  //!< The last that can have a peak, or 0.
    TPart m_part;
};

}  // namespace salma::saliency
