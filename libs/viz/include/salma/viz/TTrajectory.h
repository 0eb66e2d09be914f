// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>

#include <string>
#include <vector>

namespace salma::viz {

struct TStampedPose {
    double time{0};              //!< [s since 1970]
    mrpt::poses::CPose2D T_w_r;  //!< [m, rad]
};

/// Stamps never decrease; equal ones may stand side by side.
using TTrajectory = std::vector<TStampedPose>;

struct TStampedSpatialPose {
    double time{0};              //!< [s since 1970]
    mrpt::poses::CPose3D T_w_r;  //!< [m, rad]
};

/** Reads a TUM file, `t x y z qx qy qz qw`, for a robot on a plane: z, roll and pitch are dropped.
 *
 * Empty lines and lines that begin with '#' are skipped.
 * \throw std::runtime_error if the file cannot be read; std::invalid_argument "FILE:LINE: problem"
 * for a line that is not eight finite numbers, a quaternion that is not of unit length (to 1 %), a
 * stamp smaller than the one before, and for a file without any pose. */
TTrajectory readTum(const std::string& file);

/// Writes stamps with 6 decimals and poses with 9 significant digits. \throw std::runtime_error
void writeTum(const TTrajectory& trajectory, const std::string& file);
void writeTum(const std::vector<TStampedSpatialPose>& trajectory, const std::string& file);

}  // namespace salma::viz
