// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>

#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace salma::bench {

/// A way to find regions, and what it is run on. Results are found again by name().
struct TCase {
    std::string picture;
    cv::Size size;
    std::string method;  //!< "SIFT", "MSER", "plain", or an instruction set.
    double yMin{0};      //!< 0: all peaks.
    int threads{1};
    int scaleMax{33};

    std::string name() const;
    bool isOurs() const { return method != "SIFT" && method != "MSER" && method != "plain"; }
    saliency::TScaleSaliencyOptions options() const;

    /** What is timed; gives the number of regions. Objects are made beforehand.
     * \throw std::invalid_argument if this processor lacks the instruction set. */
    std::function<std::size_t(const cv::Mat&)> detector() const;
};

/// Names of the instruction sets that can be run here, "auto" first.
std::vector<std::string> instructionSets();

/// \throw std::invalid_argument for a name that is not of an instruction set.
saliency::ESimd simdNamed(const std::string& name);

/// "640x480"
std::string text(const cv::Size& size);

}  // namespace salma::bench
