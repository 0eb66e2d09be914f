// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace salma::apps {

/** A picture of 8 bits as grey, CV_8UC1, turned as its EXIF data say.
 * \throw std::runtime_error naming the file, if it is missing, not a picture, breaks off, or has
 * more than 8 bits for each channel. */
cv::Mat readGrey(const std::string& file);

/// For results that are named after their pictures.
/// \throw std::invalid_argument naming both files, if two have one name without folder and ending.
void rejectEqualStems(const std::vector<std::string>& pictures);

}  // namespace salma::apps
