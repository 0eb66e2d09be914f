// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/rtti/CObject.h>
#include <salma/observations/CObservationPanTilt.h>
#include <salma/observations/CObservationSalientLandmarks.h>
#include <salma/observations/registerClasses.h>

namespace salma::observations {
namespace {

/// A plug-in that was loaded before may have brought the class along.
void registerOnce(const mrpt::rtti::TRuntimeClassId* id) {
    if (mrpt::rtti::findRegisteredClass(id->className) == nullptr) mrpt::rtti::registerClass(id);
}

}  // namespace

void registerClasses() {
    registerOnce(CLASS_ID(CObservationSalientLandmarks));
    registerOnce(CLASS_ID(CObservationPanTilt));
}

}  // namespace salma::observations
