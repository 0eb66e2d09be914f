// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/TEllipse.h>

#include <vector>

namespace salma::saliency {

/** How many regions there are if what several of them cover counts once.
 *
 * Each region has a mask of weight one: a Gaussian window over the region enlarged by `scale`,
 * whose standard deviation is the enlarged region itself, as of a SIFT descriptor. The result is
 * the sum over all pixels of the largest mask there: the number of regions if no two masks touch, 1
 * if all are the same.
 * \param scale From the region to the window that describes it, along each axis; positive.
 * \throw std::invalid_argument if the masks span more than 2^26 pixels, or one is not finite.
 * Source: I. Rey-Otero, M. Delbracio, J.-M. Morel, "Comparing feature detectors: a bias in the
 * repeatability criteria", ICIP 2015. */
double nonRedundantCount(const std::vector<TEllipse>& regions, double scale);

}  // namespace salma::saliency
