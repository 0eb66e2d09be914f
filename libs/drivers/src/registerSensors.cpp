// SPDX-License-Identifier: BSD-3-Clause
#include <salma/drivers/CPanTiltCameraSensor.h>
#include <salma/drivers/registerSensors.h>

namespace salma::drivers {

void registerSensors() { CPanTiltCameraSensor::doRegister(); }

}  // namespace salma::drivers
