// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/initializer.h>
#include <salma/drivers/registerSensors.h>
#include <salma/sensing/registerSensors.h>
#include <salma/slam/registerClasses.h>

MRPT_INITIALIZER(registerSalmaClasses) {
    salma::slam::registerClasses();
    salma::drivers::registerSensors();
    salma::sensing::registerSensors();
}
