// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace salma::landmarks {

/** How different the two sides of a rectangle's border look.
 *
 * Histograms of grey levels in strips inside and outside of each third of each side are compared
 * by their Hellinger distance. Strips are wide enough to hold a course of bricks, so that both
 * strips of a line in a wall look alike. Integral pictures make each answer a matter of look-ups.
 */
class CStripHistograms {
 public:
    /// \param wall, valid As CBorderFinder::find() takes them, CV_8UC1.
    CStripHistograms(const cv::Mat& wall, const cv::Mat& valid);

    /** Share of the border, in [0, 1], whose inside differs from its outside; the twelve pieces
     * count by how far their distance is above `least`, up to twice as much.
     * \param strip Width of a strip along x and y [px]; it is at most a third of the rectangle. */
    double separation(const cv::Rect& r, const cv::Size& strip, double least) const;

 private:
    static constexpr int kBins = 8;
    using Histogram = std::array<float, kBins>;

    Histogram histogram(const cv::Rect& area) const;
    double distance(const cv::Rect& inside, const cv::Rect& outside) const;

    cv::Size m_size;
    std::vector<cv::Mat> m_sums;  //!< Integral picture of each bin, CV_32S.
};

}  // namespace salma::landmarks
