// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/TEllipse.h>

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace salma::bench {

/// A way to find regions in a picture.
struct TDetector {
    using Regions = std::vector<saliency::TEllipse>;

    std::string name;       //!< In tables and file names.
    std::string meaning;    //!< One line for the reader of a table.
    double windowScale{3};  //!< Size of a descriptor's window, in sizes of a region.

    /// The regions that the default options give, or the strongest of them up to a number.
    std::function<Regions(const cv::Mat& grey, std::optional<std::size_t> most)> detect;
};

/** Circular salient regions of both clusterers, affine ones, stable regions, SIFT.
 *
 * A SIFT region is the circle of KeyPoint::size, so of the scale sigma at which the keypoint was
 * found, as in OpenCV's own evaluation (which takes size / 2 as radius); a keypoint of several
 * orientations is one region. Stable regions have no strength in OpenCV: the strongest are those
 * that a lower limit of their relative change of area leaves; of equals, the largest. */
std::vector<TDetector> allDetectors();

}  // namespace salma::bench
