// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/TEllipse.h>

#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <optional>

namespace salma::saliency {

/// Half the width and height of the upright box around an ellipse [px].
cv::Size2d halfBox(const TEllipse& ellipse);

/** Area that two ellipses share [px^2], within 1e-4 of the smaller one's area; their own areas are
 * pi radius()^2. Source: own; chords summed by the midpoint rule. */
double intersectionArea(const TEllipse& first, const TEllipse& second);

/** 1 - intersection / union: 0 for equal ellipses, 1 for those that do not touch.
 * Source: K. Mikolajczyk et al., "A comparison of affine region detectors", IJCV 65, 2005, eq. 2.
 */
double overlapError(const TEllipse& first, const TEllipse& second);

/// Whether all numbers are finite and the condition number is below 1e12.
bool isInvertible(const cv::Matx33d& homography);

/** The ellipse of one picture in another, with the homography replaced by its first-order
 * approximation at the ellipse's centre.
 * \param H_b_a Maps pixels of the ellipse's picture a to pixels of picture b.
 * \return Nothing if the centre has no finite image, or the neighbourhood is squeezed to a line.
 * Source: K. Mikolajczyk et al., IJCV 65, 2005, section 4. */
std::optional<TEllipse> mapped(const cv::Matx33d& H_b_a, const TEllipse& ellipse);

}  // namespace salma::saliency
