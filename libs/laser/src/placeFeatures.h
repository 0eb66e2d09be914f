// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <Eigen/Core>
#include <cstddef>
#include <optional>

namespace salma::laser {

/** What the classifier of places looks at: the free room beside the robot's way and the nearest
 * range in each direction, both turned so that the walls run along the axes.
 * \return [numberOfPlaceFeatures()]; nothing if the scanner is tilted, sees less than a half circle
 * or less than a quarter of its readings is valid. */
std::optional<Eigen::VectorXf> placeFeatures(const mrpt::obs::CObservation2DRangeScan& scan);

/// The features of the scan with left and right exchanged.
Eigen::VectorXf mirroredFeatures(const Eigen::VectorXf& features);

std::size_t numberOfPlaceFeatures();

}  // namespace salma::laser
