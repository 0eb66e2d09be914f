// SPDX-License-Identifier: BSD-3-Clause
#include <salma/appearance/TPolarMeasurement.h>
#include <salma/slam/salientMeasurement.h>

#include <utility>

namespace salma::slam {

association::TMeasurement measurementOf(std::shared_ptr<const observations::TPatch> patch) {
    const auto polar = appearance::polarMeasurement(*patch);
    association::TMeasurement result;
    result.kind = association::ELandmarkKind::salient;
    result.z = polar.z;
    result.R = polar.R;
    result.wallAngle = polar.wallAngle;
    result.wallAngleSigma = polar.wallAngleSigma;
    result.patch = std::move(patch);
    return result;
}

}  // namespace salma::slam
