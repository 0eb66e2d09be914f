// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>
#include <string>
#include <vector>

namespace salma::bench {

/// Views of one plane.
struct TPictureSet {
    std::string name;
    std::vector<cv::Mat> pictures;             //!< Grey, CV_8UC1; at least two.
    std::vector<cv::Matx33d> H_picture_first;  //!< Maps pixels of the first picture to each one's.
};

/** Reads a folder as VGG's affine-covariant set has it (img1.ppm ..., H1to2p ...) or HPatches
 * (1.png ..., H_1_2 ...). Pictures may be ppm, pgm, png or jpg; the set is named after the folder.
 * \throw std::runtime_error naming the file, if a picture or a homography is missing or cannot be
 * read. */
TPictureSet readPictureSet(const std::string& folder);

/// How two views differ, at the middle of the first picture.
struct TViewChange {
    double scale{1};    //!< Size in the second picture, of what has size one in the first.
    double stretch{1};  //!< Largest by smallest scale over all directions, from 1.
};
TViewChange viewChange(const cv::Matx33d& H_2_1, const cv::Size& first);

}  // namespace salma::bench
