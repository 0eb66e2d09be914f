// SPDX-License-Identifier: BSD-3-Clause
#include <salma/drivers/CLms200.h>
#include <salma/drivers/CNoddingLaser.h>
#include <salma/drivers/CPanTiltCameraSensor.h>
#include <salma/drivers/CWheelOdometry.h>
#include <salma/drivers/registerSensors.h>

namespace salma::drivers {

void registerSensors() {
    CLms200::doRegister();
    CNoddingLaser::doRegister();
    CPanTiltCameraSensor::doRegister();
    CWheelOdometry::doRegister();
}

}  // namespace salma::drivers
