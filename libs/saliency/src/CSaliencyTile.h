// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "scaleKernels.h"

namespace salma::saliency {

constexpr int kTileRows = 64;  // so that the planes of a tile fit into a second-level cache
constexpr int kBandRows = 8;   // so that the window of one bin fits into a first-level cache
constexpr int kGroup = 16;     // centres for which entropies are computed or left out together

/** Finds the peaks of up to kLanes x kTileRows centres; its buffers serve one tile after another.
 * One per thread. */
template <class COUNT>
class CSaliencyTile {
 public:
    using TRegions = std::vector<observations::TSalientRegion>;

    CSaliencyTile(const TScaleTables& tables, const TKernels<COUNT>& kernels);

    /** \param bins The picture's cells of the histogram, CV_8UC1.
     * \param centres Which pixels are centres; at least sMax from each border.
     * \param rows One list for each row of centres, to which its peaks are added by column, scale.
     */
    void detect(const cv::Mat& bins, const cv::Rect& centres, double yMin, TRegions* rows);

 private:
    void fillPlanes(const cv::Mat& bins, const cv::Rect& window);
    void fillPlane(const cv::Mat& bins, const cv::Rect& window, std::size_t bin);
    TPlanes<COUNT> planesOf(std::size_t bin) const;
    /// Bins with a pixel in the discs of the centres of `count` rows from `row`.
    void findPresent(int row, int count);
    void detectBand(const cv::Rect& centres, int row, TRegions* rows);
    void sumRow(int bandRow);
    /// Marks the groups of centres that may hold a peak with Y >= m_yMin at a scale.
    void findNeeded();
    void computeEntropies();
    void computeEntropies(std::size_t k, std::size_t firstLane);
    void emitPeaks(const cv::Point& firstCentre, int count, TRegions& found) const;

    const TScaleTables& m_tables;
    TKernels<COUNT> m_kernels;
    std::size_t m_scales;
    int m_stride;
    double m_yMin{0};
    double m_entropyBound{0};  //!< log of the number of bins in m_present.

    std::vector<std::vector<COUNT>> m_planes;        //!< Of each bin: three arrays.
    std::vector<std::vector<std::uint8_t>> m_inRow;  //!< [bin][row] whether it occurs there.
    std::vector<std::size_t> m_present;              //!< Bins, ascending.
    std::vector<COUNT> m_scratch;
    std::vector<COUNT> m_discs;           //!< [band row][present][scale][lane]
    std::vector<std::uint16_t> m_counts;  //!< [scale][present][lane]
    std::vector<std::int32_t> m_change;   //!< [scale][lane]
    std::vector<double> m_w;              //!< [scale][lane]
    std::vector<double> m_h;              //!< [scale][lane], where needed.
    std::vector<std::uint8_t> m_needed;   //!< [scale][group]
};

}  // namespace salma::saliency
