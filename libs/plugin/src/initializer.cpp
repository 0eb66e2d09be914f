// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/initializer.h>
#include <salma/drivers/registerSensors.h>
#include <salma/observations/registerClasses.h>

MRPT_INITIALIZER(registerSalmaClasses) {
    salma::observations::registerClasses();
    salma::drivers::registerSensors();
}
