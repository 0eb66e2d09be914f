// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <vector>

namespace salma::observations {

/// The observations of one sensory frame.
using TFrame = std::vector<mrpt::obs::CObservation::Ptr>;

/** Which frame each record belongs to: the one that holds the observation nearest in time. Of
 * frames equally near, the first to which no record of the same sensor was given before, else the
 * last; so the k-th record of several equal stamps goes to the k-th frame of that stamp.
 * \return Index into `frames` for each record. \pre `frames` is not empty. */
std::vector<std::size_t> nearestFrames(const std::vector<TFrame>& frames, const TFrame& records);

}  // namespace salma::observations
