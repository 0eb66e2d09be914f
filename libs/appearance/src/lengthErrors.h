// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/TPatch.h>

namespace salma::appearance {

/// Relative variance of lengths along u and along v on a patch [-].
struct TLengthErrors {
    double u{0}, v{0};
};

/** What the pose's covariance means for lengths on the patch, and for the resolution of the view:
 * for incidence phi and a distance h to the wall, a length along u errs by 2 tan(phi) d_phi + dh /
 * h, one along v by tan(phi) d_phi + dh / h. NaN if the pose is not finite, or is the robot's own.
 */
TLengthErrors lengthErrors(const observations::TPatch& patch);

}  // namespace salma::appearance
