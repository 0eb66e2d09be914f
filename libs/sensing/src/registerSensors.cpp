// SPDX-License-Identifier: BSD-3-Clause
#include <salma/sensing/CSalientLandmarkSensor.h>
#include <salma/sensing/registerSensors.h>

namespace salma::sensing {

void registerSensors() { CSalientLandmarkSensor::doRegister(); }

}  // namespace salma::sensing
