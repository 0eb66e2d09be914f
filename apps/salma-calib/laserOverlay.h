// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/calibration/CLaserCameraCalibrator.h>

#include <opencv2/core/mat.hpp>

namespace salma::apps {

/** The picture with the scan projected into it: ends of beams on the board green, others orange.
 * \param grey CV_8UC1. \return CV_8UC3. Source: after Ho, transfer report, 2004, appendix A. */
cv::Mat drawLaser(const cv::Mat& grey,
                  const mrpt::img::TCamera& camera,
                  const calibration::TRangeScan& scan,
                  const calibration::TLaserCameraCalibration& calibration,
                  const calibration::TPairFit& pair);

}  // namespace salma::apps
