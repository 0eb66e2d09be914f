// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace salma::slam {

/// Makes the metric map known to MRPT, to its serialisation and, as `salientLandmarkMap`, to the
/// map lists of ini files; the records of `observations` too. Repeated calls do nothing.
void registerClasses();

}  // namespace salma::slam
