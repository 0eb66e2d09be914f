// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CQuadrilaterals.h>
#include <salma/saliency/CStableRegions.h>
#include <salma/saliency/TEllipse.h>

#include <cstddef>
#include <opencv2/core/matx.hpp>
#include <string>
#include <vector>

namespace salma::saliency {

/** Writes regions as the affine-covariant benchmark reads them: "1.0", the count, then one line
 * "u v a b c" for each, (0,0) being the centre of the first pixel.
 * Source: K. Mikolajczyk et al., "A comparison of affine region detectors", IJCV 65, 2005.
 * \throw std::runtime_error if the file cannot be written. */
void writeVgg(const std::string& file, const std::vector<TEllipse>& regions);

/** Reads what writeVgg and the programs of the benchmark write. The first number is the length of
 * the descriptors that follow each ellipse in its line; they are left out. 1.0 and 0 both stand for
 * none: programs write either.
 * \param most More regions are an error.
 * \throw std::runtime_error if the file cannot be read, or "FILE:LINE: problem" if a line is not
 * what it should be, an ellipse is not one, or lines are missing or too many. */
std::vector<TEllipse> readVgg(const std::string& file, std::size_t most = 1000000000);

/** Reads a homography of the same benchmark, or of HPatches: three lines of three numbers.
 * \throw std::runtime_error if the file cannot be read, "FILE:LINE: problem" if a line is not what
 * it should be, lines are missing or too many, or the matrix is singular. */
cv::Matx33d readHomography(const std::string& file);

/** Writes `x_px,y_px,scale_px,entropy,interscale,saliency`, one line for each region.
 * \throw std::runtime_error if the file cannot be written. */
void writeRegionsCsv(const std::string& file,
                     const std::vector<observations::TSalientRegion>& regions);

/** Writes the same columns, the last three of them empty, and `area_px2,mean_grey,polarity` (dark
 * or bright). \throw std::runtime_error if the file cannot be written. */
void writeRegionsCsv(const std::string& file, const std::vector<TStableRegion>& regions);

/** Writes `x0_px,y0_px` to `x3_px,y3_px`, the corners clockwise from the top left, and `area_px2`.
 * \throw std::runtime_error if the file cannot be written. */
void writeQuadsCsv(const std::string& file, const std::vector<TQuad>& quads);

}  // namespace salma::saliency
