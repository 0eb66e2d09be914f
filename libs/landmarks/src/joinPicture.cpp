// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <salma/landmarks/joinPicture.h>

#include <cmath>

namespace salma::landmarks {

EJoin joinPicture(TJoinedPicture& job, const TPictureContext& context) {
    if (!job.scan) return EJoin::noScan;
    const double scanTime = mrpt::Clock::toDouble(job.scan->timestamp);
    if (!(context.scanIsNear || std::abs(scanTime - context.time) <= context.maxSkew))
        return EJoin::noScan;
    if (!context.odometry.empty()) {
        const auto atPicture = context.odometry.at(context.time, context.maxSkew);
        const auto atScan = context.odometry.at(scanTime, context.maxSkew);
        if (atPicture && atScan) job.T_picture_scan = *atScan - *atPicture;
    }
    job.T_r_c = job.picture->cameraPose;
    if (!context.panTilt.empty()) {
        const auto pose = context.panTilt.cameraPose(context.time, context.maxSkew);
        if (!pose) return EJoin::noHeadPose;
        job.T_r_c = *pose;
    }
    return EJoin::joined;
}

}  // namespace salma::landmarks
