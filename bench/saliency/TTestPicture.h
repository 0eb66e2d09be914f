// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <ostream>
#include <string>
#include <vector>

namespace salma::bench {

struct TTestPicture {
    std::string name;
    cv::Mat grey;  //!< CV_8UC1, of the file's size.

    /// [height x width] \return the picture enlarged or reduced to a size, whatever its shape.
    cv::Mat resized(const cv::Size& size) const;
};

/** Those of `names` that exist on this computer: corridor and graf below `dataFolder`, stereo-calib
 * of MRPT's package, and synthetic, a picture of discs of all sizes and greys with noise, which is
 * always there. What is missing is said on `out`. \param names Empty for all. \throw
 * std::invalid_argument for a name that is not known. */
std::vector<TTestPicture> testPictures(const std::string& dataFolder,
                                       const std::vector<std::string>& names,
                                       std::ostream& out);

}  // namespace salma::bench
