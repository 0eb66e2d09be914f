// SPDX-License-Identifier: BSD-3-Clause
#include <salma/appearance/rectifyQuad.h>
#include <salma/calibration/CHomography.h>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace salma::appearance {

cv::Mat rectifyQuad(const cv::Mat& grey,
                    const std::vector<mrpt::math::TPoint2D>& corners,
                    const cv::Size& size) {
    if (grey.type() != CV_8UC1)
        throw std::invalid_argument("rectification needs a grey picture of 8 bits");
    if (size.width < 1 || size.height < 1)
        throw std::invalid_argument("rectification needs a size of at least one pixel");
    const double right = size.width - 0.5, bottom = size.height - 0.5;
    const auto H = calibration::CHomography::through(
        {{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}, corners);
    if (!H || !(H->matrix().determinant() > 0)) return {};  // mirrored, or in another order
    cv::Matx33d map;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) map(r, c) = H->matrix()(r, c);
    cv::Mat out;
    cv::warpPerspective(grey, out, map, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                        cv::BORDER_REPLICATE);
    return out;
}

}  // namespace salma::appearance
