// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "ringKernels.h"
#include "searchKernels.h"

namespace salma::saliency {

/// A peak of a row of centres; its Y is H W.
struct TPeak {
    std::uint16_t column{0};  //!< Centre [px].
    std::uint16_t scale{0};   //!< Radius [px].
    double H{0};
    double W{0};
};

/// Peaks of a tile by row, column, scale; those of a row end where those of the next begin.
struct TTilePeaks {
    std::vector<TPeak> peaks;
    std::array<std::size_t, kTileRows> ends{};
};

/** Finds the peaks of up to kLanes x kTileRows centres; its buffers serve one tile after another.
 * One per thread. */
template <class COUNT>
class CSaliencyTile {
 public:
    CSaliencyTile(const TScaleTables& tables, ESimd simd);

    /** \param bins The picture's cells of the histogram, CV_8UC1.
     * \param centres Which pixels are centres; at least sMax from each border. */
    TTilePeaks detect(const cv::Mat& bins, const cv::Rect& centres, double yMin);

 private:
    struct TCandidate {
        int x{0};
        int k{0};
    };

    void fillBitmaps(const cv::Mat& window);
    /// Bins with a pixel in the discs of the centres of `count` rows from `row`.
    void findPresent(int row, int count);
    void detectBand(const cv::Rect& centres, int row, TTilePeaks& found);
    /// Counts a bin in the band that begins with `row`, up to a number of scales.
    void countBin(std::size_t present, int row, int scales);
    int bandWindow() const { return kBandRows + 2 * m_tables.sMax; }
    /// Indices of the present bins, that with most pixels in the band's window first.
    std::vector<std::size_t> byPixels(int row) const;
    void countAll(int row);
    /** Counts bins, the most frequent first, only as long and as far as there can be a peak.
     * \return The last scale that can have one, for each row and part; 0 if none can. */
    void countNeeded(const cv::Size& centres, int row);
    std::vector<std::uint16_t> leastChanges() const;
    void searchPart(int bandRow, int x);
    /// Peaks of a part of which `count` centres exist, the first in `firstColumn`.
    void emitPeaks(int firstColumn, int count, std::vector<TPeak>& found);
    /// Peaks of entropy of a part, into m_candidates. \return How many.
    std::size_t findCandidates(int count);
    bool isPeak(int k, int x) const;
    /// H of kTogether candidates at once: one alone would wait for its own additions.
    void computeEntropies(const TCandidate* candidates, double* h) const;

    static constexpr std::size_t kTogether = 4;

    const TScaleTables& m_tables;
    TRingKernels<COUNT> m_ringKernels;
    TSearchKernels<COUNT> m_searchKernels;
    int m_scales;
    double m_yMin{0};
    bool m_prunes{false};  //!< Whether the band leaves out what m_yMin excludes before counting it.
    std::size_t m_ofBin;   //!< Counts of a bin in a row of centres.

    std::vector<hwy::AlignedFreeUniquePtr<std::uint64_t[]>> m_bitmaps;  //!< Of each bin.
    std::vector<std::vector<std::uint16_t>> m_perRow;                   //!< [bin][row] pixels.
    std::vector<std::size_t> m_present;                                 //!< Bins, ascending.
    hwy::AlignedFreeUniquePtr<COUNT[]> m_rings;  //!< [band row][present][scale][lane]
    std::size_t m_ringsSize{0};
    hwy::AlignedFreeUniquePtr<std::uint16_t[]> m_overlap;  //!< [band row][scale][lane]
    int m_lastScales[kBandRows][kLanes / kPart]{};         //!< The last that can have a peak, or 0.
    TPart m_part;
    std::vector<TCandidate> m_candidates;  //!< Peaks of entropy of a part, by centre, scale.
    std::vector<TPeak> m_peaks;            //!< Those of them that are peaks above the threshold.
};

}  // namespace salma::saliency
