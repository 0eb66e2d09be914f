// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/TPatch.h>

#include <Eigen/Core>

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

/** Covariance of (e_u, e_v, turn): by how much all lengths on a patch err along u and along v, and
 * how far the patch is turned in its plane [-, -, rad]. From range, bearing and wall angle:
 * e_u = dr / r + tan(phi) d_phi, e_v = dr / r with phi the signed incidence; the turn is the pose's
 * pitch. The camera is taken to stand above the robot's origin. The patch must not be there. */
Eigen::Matrix3d metricErrors(const observations::TPatch& patch);

}  // namespace salma::appearance
