// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/laser/TLine.h>
#include <salma/observations/CObservationSalientLandmarks.h>
#include <salma/observations/TPatch.h>
#include <salma/slam/CSlamBackend.h>

namespace salma::apps {

/// Where the diagonals of the patch's quad cross: its centre in the picture [px].
mrpt::math::TPoint2D centreOf(const observations::TPatch& patch);

/// Each appends one measurement, with its place in the picture if it has one.
/// T_r_c is the camera on the robot, in its optical frame.
void addCorner(const laser::TCorner& corner, slam::TStepInput& step);
void addPatch(const observations::TPatch& patch,
              const mrpt::poses::CPose3D& T_r_c,
              slam::TStepInput& step);
void addMeasurement(const association::TMeasurement& measurement, slam::TStepInput& step);

/// What a scan saw; none where its geometry makes no sense.
std::optional<slam::TLaserView> laserView(const mrpt::obs::CObservation2DRangeScan& scan);

/// Where a picture looked; none without intrinsics. \param mostPosters Taken from it, at most.
std::optional<slam::TCameraView> cameraView(
    const observations::CObservationSalientLandmarks& record, std::size_t mostPosters);

}  // namespace salma::apps
