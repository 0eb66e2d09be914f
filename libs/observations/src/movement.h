// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <optional>

namespace salma::observations {

/// A motion, in the plane and, where the log has it so, in space.
struct TMovement {
    mrpt::poses::CPosePDFGaussian flat;
    std::optional<mrpt::poses::CPose3DPDFGaussian> spatial;

    /// Another motion after this one; in space only where both are.
    TMovement& operator+=(const TMovement& next);
};

/** Motion that a collection of actions states: MRPT's best 2D estimate, else the 3D odometry seen
 * from above. Nothing if it states none. MRPT draws the particles of an odometry action with
 * Thrun's model afresh at each reading; for these the first-order covariance of that model is
 * taken, so that the same file always gives the same numbers.
 * \throw std::runtime_error for a collection with empty entries.
 * Source: S. Thrun, W. Burgard, D. Fox, Probabilistic Robotics, 2005, table 5.6. */
std::optional<TMovement> movementOf(const mrpt::obs::CActionCollection& actions);

}  // namespace salma::observations
