// SPDX-License-Identifier: BSD-3-Clause
#include "CPictureWork.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <salma/observations/loadPicture.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "CProgressBar.h"
#include "parallelFor.h"

namespace salma::apps {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationImage;
using observations::CObservationSalientLandmarks;

/// A picture with all that it is joined with.
struct CPictureWork::TJob {
    CObservationImage::Ptr picture;
    CObservation2DRangeScan::Ptr scan;
    mrpt::poses::CPose2D T_picture_scan;  //!< Robot at the scan's time, seen from the picture's.
    mrpt::poses::CPose3D T_r_c;
};

namespace {

double stampOf(const mrpt::obs::CObservation& observation) {
    return mrpt::Clock::toDouble(observation.timestamp);
}

std::set<mrpt::Clock::time_point> recordedStamps(const observations::TLog& log) {
    std::set<mrpt::Clock::time_point> stamps;
    for (const auto& step : log.steps)
        for (const auto& o : step.observations)
            if (std::dynamic_pointer_cast<CObservationSalientLandmarks>(o))
                stamps.insert(o->timestamp);
    return stamps;
}

/// The scan nearest in time within one frame, or within the whole log if its frames hold one each.
CObservation2DRangeScan::Ptr nearestScan(const observations::TLog& log,
                                         std::size_t step,
                                         double time) {
    CObservation2DRangeScan::Ptr best;
    const auto consider = [&](const observations::TLogStep& other) {
        for (const auto& o : other.observations) {
            const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(o);
            if (scan &&
                (!best || std::abs(stampOf(*scan) - time) < std::abs(stampOf(*best) - time)))
                best = scan;
        }
    };
    consider(log.steps[step]);
    if (log.actionFormat) return best;
    constexpr std::size_t kReach = 100;  // steps to look at on each side; scans come many a second
    for (std::size_t i = step - std::min(step, kReach);
         i < std::min(log.steps.size(), step + kReach); ++i)
        consider(log.steps[i]);
    return best;
}

}  // namespace

CPictureWork::CPictureWork(const TSlamConfig& config, const observations::TLog& log)
    : m_config(config),
      m_log(log),
      m_frontEnd(config.seeing),
      m_lines(config.lines),
      m_placeString(config.placeString) {}

std::vector<CPictureWork::TJob> CPictureWork::jobs(TSeen& seen) const {
    const auto recorded = recordedStamps(m_log);
    std::vector<TJob> result;
    for (std::size_t i = 0; i < m_log.steps.size(); ++i)
        for (const auto& o : m_log.steps[i].observations) {
            TJob job;
            job.picture = std::dynamic_pointer_cast<CObservationImage>(o);
            if (!job.picture) continue;
            ++seen.pictures;
            const double time = stampOf(*job.picture) - m_config.seeing.frontEnd.latencyCamera;
            job.scan = nearestScan(m_log, i, time);
            if (recorded.count(job.picture->timestamp) != 0)
                ++seen.alreadyRecorded;
            else if (!observations::hasPicture(*job.picture, m_log.imagesFolder))
                ++seen.filesMissing;
            else if (join(job, seen))
                result.push_back(job);
        }
    return result;
}

/// Finds scan, motion and camera pose for the picture of `job`; false, counted, without them.
bool CPictureWork::join(TJob& job, TSeen& seen) const {
    const auto& options = m_config.seeing.frontEnd;
    const double time = stampOf(*job.picture) - options.latencyCamera;
    const double skew = job.scan ? std::abs(stampOf(*job.scan) - time) : 0;
    if (!job.scan || !(m_log.actionFormat || skew <= options.maxSkew)) {
        ++seen.withoutScan;
        return false;
    }
    if (!m_log.odometry.empty()) {
        const auto atPicture = m_log.odometry.at(time, options.maxSkew);
        const auto atScan = m_log.odometry.at(stampOf(*job.scan), options.maxSkew);
        if (atPicture && atScan) job.T_picture_scan = *atScan - *atPicture;
    }
    job.T_r_c = job.picture->cameraPose;
    if (!m_log.panTilt.empty()) {
        const auto pose = m_log.panTilt.cameraPose(time, options.maxSkew);
        if (!pose) ++seen.withoutHeadPose;
        if (!pose) return false;
        job.T_r_c = *pose;
    }
    return true;
}

CObservationSalientLandmarks::Ptr CPictureWork::look(const TJob& job,
                                                     landmarks::TFrontEndResult& result) const {
    landmarks::TView view;
    view.grey = observations::loadGrey(*job.picture, m_log.imagesFolder);
    view.camera = job.picture->cameraParams;
    view.T_r_c = job.T_r_c;
    const laser::TLineResult lines = m_lines.extract(*job.scan);
    for (const auto& line : lines.lines)
        view.walls.push_back(laser::transformed(line, job.T_picture_scan));
    result = m_frontEnd.process(view);

    auto record = CObservationSalientLandmarks::Create();
    record->sensorLabel = job.picture->sensorLabel + "_SALIENT";
    record->timestamp = job.picture->timestamp;
    record->cameraPose = view.T_r_c;
    record->camera = view.camera;
    if (job.picture->image.isExternallyStored())
        record->pictureFile = job.picture->image.getExternalStorageFile();
    record->placeString = m_placeString.describe(*job.scan, lines);
    record->landmarks = result.landmarks;
    return record;
}

TSeen CPictureWork::run() const {
    TSeen seen;
    const auto all = jobs(seen);
    seen.records.resize(all.size());
    std::vector<landmarks::TFrontEndResult> results(all.size());
    CProgressBar progress("pictures", all.size());
    parallelFor(all.size(), m_config.run.threads, [&](std::size_t i) {
        seen.records[i] = look(all[i], results[i]);
        progress.step();
    });
    for (const auto& result : results) {
        seen.split += result.split;
        for (const auto& [reason, count] : result.refused) seen.refused[reason] += count;
    }
    return seen;
}

}  // namespace salma::apps
