// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/rtti/CObject.h>
#include <salma/observations/registerClasses.h>
#include <salma/slam/CSalientLandmarkMap.h>
#include <salma/slam/registerClasses.h>

namespace salma::slam {

// The map's definition registers itself when its object file is linked, which this call sees to.
void registerClasses() {
    observations::registerClasses();  // the patches of a map are stored as records
    mrpt::rtti::registerClass(CLASS_ID(CSalientLandmarkMap));
}

}  // namespace salma::slam
