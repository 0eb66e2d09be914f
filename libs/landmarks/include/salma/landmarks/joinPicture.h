// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <salma/observations/CPanTiltHistory.h>
#include <salma/observations/CPoseHistory.h>

namespace salma::landmarks {

/// A picture with all that the front end wants to know with it.
struct TJoinedPicture {
    mrpt::obs::CObservationImage::Ptr picture;
    mrpt::obs::CObservation2DRangeScan::Ptr scan;
    mrpt::poses::CPose2D T_picture_scan;  //!< Robot at the scan's time, seen from the picture's.
    mrpt::poses::CPose3D T_r_c;           //!< At the picture's time.
};

enum class EJoin { joined, noScan, noHeadPose };

/// What is known of the time around a picture. Histories that are empty are not asked.
struct TPictureContext {
    const observations::CPoseHistory& odometry;
    const observations::CPanTiltHistory& panTilt;
    double time{0};          //!< At which the picture was taken: its stamp less the latency [s].
    double maxSkew{0};       //!< Poses are held this long beyond the ends of their history [s].
    bool scanIsNear{false};  //!< The scan belongs to the picture, whatever its stamp says.
};

/** Fills motion and camera pose of `job`, which has picture and scan already.
 *
 * The robot's motion between picture and scan is that of the odometry where it is known, else none.
 * The camera's pose is that of the head, else the picture's own.
 * \return noScan if `job.scan` is null or further than `maxSkew` from the picture; noHeadPose if
 * there is a head, but nothing is known of it at that time. */
EJoin joinPicture(TJoinedPicture& job, const TPictureContext& context);

}  // namespace salma::landmarks
