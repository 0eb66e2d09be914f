// SPDX-License-Identifier: BSD-3-Clause
#include <salma/sensing/gazeAt.h>

#include <cmath>

namespace salma::sensing {

TGaze gazeAt(const observations::CObservationPanTilt& head, const mrpt::math::TPoint3D& point) {
    const auto fromBase = head.basePose.inverseComposePoint(point);
    TGaze gaze;
    gaze.pan = std::atan2(fromBase.y, fromBase.x);
    gaze.tilt = std::atan2(fromBase.z, std::hypot(fromBase.x, fromBase.y));
    // The camera sits beside the axes, so that what is left is taken off step by step.
    constexpr int kSteps = 10;
    for (int i = 0; i < kSteps; ++i) {
        const auto seen = head.cameraPose(gaze.pan, gaze.tilt).inverseComposePoint(point);
        gaze.pan -= std::atan2(seen.x, seen.z);
        gaze.tilt -= std::atan2(seen.y, std::hypot(seen.x, seen.z));
    }
    return gaze;
}

}  // namespace salma::sensing
