// SPDX-License-Identifier: BSD-3-Clause
#include "laserOverlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace salma::apps {

cv::Mat drawLaser(const cv::Mat& grey,
                  const mrpt::img::TCamera& camera,
                  const calibration::TRangeScan& scan,
                  const calibration::TLaserCameraCalibration& calibration,
                  const calibration::TPairFit& pair) {
    cv::Mat picture;
    cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
    const cv::Matx33d K(camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1);
    const std::vector<double> lens(camera.dist.begin(), camera.dist.begin() + 5);
    const int radius = std::max(2, grey.cols / 250);
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
        const double r = scan.ranges[i] - calibration.rangeOffset, a = scan.direction(i);
        if (!std::isfinite(r)) continue;
        mrpt::math::TPoint3D X;
        calibration.T_l_c.inverseComposePoint(
            mrpt::math::TPoint3D(r * std::cos(a), r * std::sin(a), 0), X);
        // far outside of the picture the lens model does not hold
        if (!(X.z > 0.05) || std::hypot(X.x, X.y) > 1.5 * X.z) continue;
        std::vector<cv::Point2d> pixel;
        cv::projectPoints(std::vector<cv::Point3d>{{X.x, X.y, X.z}}, cv::Vec3d(0, 0, 0),
                          cv::Vec3d(0, 0, 0), K, lens, pixel);
        if (!cv::Rect2d(0, 0, grey.cols, grey.rows).contains(pixel[0])) continue;
        const bool onBoard = std::binary_search(pair.beams.begin(), pair.beams.end(), i);
        cv::circle(picture, cv::Point(pixel[0]), radius,
                   onBoard ? cv::Scalar(60, 200, 0) : cv::Scalar(0, 130, 255), cv::FILLED,
                   cv::LINE_AA);
    }
    return picture;
}

}  // namespace salma::apps
