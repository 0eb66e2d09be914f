// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/initializer.h>

#include "CReplaySensor.h"

MRPT_INITIALIZER(registerReplaySensor) { salma::test::CReplaySensor::doRegister(); }
