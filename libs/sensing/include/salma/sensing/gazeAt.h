// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/CObservationPanTilt.h>

namespace salma::sensing {

/// Angles of a head [rad]: pan positive to the left, tilt upwards.
struct TGaze {
    double pan{0};
    double tilt{0};
};

/** Where a head must look for `point` to appear in the middle of the picture.
 * \param head Says where the head and the camera on it are mounted.
 * \param point Robot frame [m]. */
TGaze gazeAt(const observations::CObservationPanTilt& head, const mrpt::math::TPoint3D& point);

}  // namespace salma::sensing
