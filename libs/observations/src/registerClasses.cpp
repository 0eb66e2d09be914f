// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/rtti/CObject.h>
#include <salma/observations/CObservationPanTilt.h>
#include <salma/observations/CObservationSalientLandmarks.h>
#include <salma/observations/registerClasses.h>

namespace salma::observations {

void registerClasses() {
    mrpt::rtti::registerClass(CLASS_ID(CObservationSalientLandmarks));
    mrpt::rtti::registerClass(CLASS_ID(CObservationPanTilt));
}

}  // namespace salma::observations
