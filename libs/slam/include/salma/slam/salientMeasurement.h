// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TMeasurement.h>

namespace salma::slam {

/// What a filter in the plane takes from a patch, which the measurement holds from now on.
/// \throw std::invalid_argument if the centre of the patch is at the robot's origin.
association::TMeasurement measurementOf(std::shared_ptr<const observations::TPatch> patch);

}  // namespace salma::slam
