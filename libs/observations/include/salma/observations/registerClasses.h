// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace salma::observations {

/// Makes the records of this library known to MRPT's serialisation. Repeated calls do nothing.
void registerClasses();

}  // namespace salma::observations
