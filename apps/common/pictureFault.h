// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace salma::apps {

/** What makes a picture useless, by its content: "black", "of one brightness all over", "cut: ..."
 * where the lower eighth of the rows or more are one row over and over, which is what decoders show
 * for what did not come; "" if nothing. \param grey [h x w] CV_8UC1, not empty. */
std::string faultOf(const cv::Mat& grey);

}  // namespace salma::apps
