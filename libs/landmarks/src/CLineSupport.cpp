// SPDX-License-Identifier: BSD-3-Clause
#include "CLineSupport.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace salma::landmarks {
namespace {

/// Half of a side may be weaker than a side needs while its extent is not known yet.
constexpr double kLeastShare = 0.5;

/// Sums from the first row down, with a row of zeros on top.
cv::Mat summedDown(const cv::Mat& values, int type) {
    cv::Mat sum = cv::Mat::zeros(values.rows + 1, values.cols, type);
    for (int y = 0; y < values.rows; ++y) {
        cv::Mat row;
        values.row(y).convertTo(row, type);
        cv::Mat next = sum.row(y + 1);
        cv::add(sum.row(y), row, next);
    }
    return sum;
}

}  // namespace

CLineSupport::CLineSupport(const cv::Mat& wall, const cv::Mat& valid, double contrast) {
    cv::Mat smooth, change, known;
    cv::GaussianBlur(wall, smooth, {3, 3}, 0.8);
    cv::Sobel(smooth, change, CV_32F, 1, 0, 3, 1.0 / 8);
    change = cv::abs(change);
    cv::erode(valid, known, cv::Mat::ones(3, 3, CV_8U));
    change.setTo(0, known == 0);
    m_contrast = summedDown(change, CV_32F);
    cv::Mat wide;
    cv::dilate(change, wide, cv::Mat::ones(1, 3, CV_8U));
    m_edges = summedDown((wide >= contrast) / 255, CV_32S);
}

double CLineSupport::share(int column, const cv::Range& rows) const {
    const int from = std::clamp(rows.start, 0, m_edges.rows - 1);
    const int to = std::clamp(rows.end, 0, m_edges.rows - 1);
    if (to <= from) return 0;
    return static_cast<double>(m_edges.at<int>(to, column) - m_edges.at<int>(from, column)) /
           (to - from);
}

double CLineSupport::strength(int column, const cv::Range& rows) const {
    return m_contrast.at<float>(rows.end, column) - m_contrast.at<float>(rows.start, column);
}

std::vector<int> CLineSupport::lines(const cv::Range& range, const cv::Range& rows) const {
    std::vector<int> found;
    for (int x = std::max(1, range.start); x < std::min(range.end, m_edges.cols - 1); ++x) {
        if (!(share(x, rows) >= kLeastShare)) continue;
        const double here = strength(x, rows);
        if (here >= strength(x - 1, rows) && here > strength(x + 1, rows)) found.push_back(x);
    }
    return found;
}

}  // namespace salma::landmarks
