// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace salma::sensing {

/// Makes the sensors of this library known to MRPT by their names (`driver = ...` of an ini file).
/// Repeated calls do nothing.
void registerSensors();

}  // namespace salma::sensing
