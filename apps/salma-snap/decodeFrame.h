// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "CVideoDevice.h"

namespace salma::apps {

enum class EDeinterlace {
    automatic,  //!< line for interlaced pictures, none for others.
    none,       //!< As it came.
    line,       //!< Keep the upper field, its lines between are means of two.
    blend       //!< Mean of both fields: what moves is seen twice.
};

/// Does decodeFrame() know this pixel format?
bool canDecode(std::uint32_t fourcc);

/** The bytes of a frame as a picture, CV_8UC3 (BGR) or, for grey formats, CV_8UC1.
 * \throw std::runtime_error saying what is wrong with them: too few, or no picture. */
cv::Mat decodeFrame(const CVideoDevice::TFormat& format, const std::vector<std::uint8_t>& bytes);

/** One instant instead of two whose lines alternate.
 * \param field V4L2_FIELD_... of `picture`, which tells `automatic` what to do. */
cv::Mat deinterlace(const cv::Mat& picture, std::uint32_t field, EDeinterlace how);

}  // namespace salma::apps
