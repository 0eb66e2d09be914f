// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace salma::landmarks {

/** How much of an upright line in a picture is an edge.
 *
 * A pixel is an edge if the grey level changes along x by at least `contrast` per pixel there or
 * one pixel beside: camera and laser are not perfectly joined. Sums along columns make each answer
 * a matter of two look-ups. */
class CLineSupport {
 public:
    CLineSupport(const cv::Mat& wall, const cv::Mat& valid, double contrast);

    /// Share of the rows at which the column is an edge; rows that are not known are none, and rows
    /// outside the picture do not count. 0 for no row.
    double share(int column, const cv::Range& rows) const;

    /// Columns of `range` that are more of an edge over `rows` than their neighbours.
    std::vector<int> lines(const cv::Range& range, const cv::Range& rows) const;

 private:
    double strength(int column, const cv::Range& rows) const;

    cv::Mat m_edges;     //!< [rows + 1 x columns] edge pixels above a row, CV_32S.
    cv::Mat m_contrast;  //!< The same sum of the contrast, CV_32F.
};

}  // namespace salma::landmarks
