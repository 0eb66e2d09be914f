// SPDX-License-Identifier: BSD-3-Clause
#include "CPictureWork.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <salma/observations/loadPicture.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "CProgressBar.h"
#include "parallelFor.h"

namespace salma::apps {

using landmarks::TJoinedPicture;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationImage;
using observations::CObservationSalientLandmarks;

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
    : m_config(config), m_log(log), m_recorder({config.lines, config.placeString, config.seeing}) {}

std::vector<TJoinedPicture> CPictureWork::jobs(TSeen& seen) const {
    const auto recorded = recordedStamps(m_log);
    std::vector<TJoinedPicture> result;
    for (std::size_t i = 0; i < m_log.steps.size(); ++i)
        for (const auto& o : m_log.steps[i].observations) {
            TJoinedPicture job;
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

/// Finds motion and camera pose for the picture of `job`; false, counted, without them.
bool CPictureWork::join(TJoinedPicture& job, TSeen& seen) const {
    const auto& options = m_config.seeing.frontEnd;
    const double time = stampOf(*job.picture) - options.latencyCamera;
    switch (joinPicture(
        job, {m_log.odometry, m_log.panTilt, time, options.maxSkew, m_log.actionFormat})) {
        case landmarks::EJoin::joined:
            return true;
        case landmarks::EJoin::noScan:
            ++seen.withoutScan;
            break;
        case landmarks::EJoin::noHeadPose:
            ++seen.withoutHeadPose;
    }
    return false;
}

TSeen CPictureWork::run() const {
    TSeen seen;
    const auto all = jobs(seen);
    seen.records.resize(all.size());
    std::vector<landmarks::TFrontEndResult> results(all.size());
    CProgressBar progress("pictures", all.size());
    parallelFor(all.size(), m_config.run.threads, [&](std::size_t i) {
        auto recorded = m_recorder.record(all[i], m_log.imagesFolder);
        seen.records[i] = recorded.record;
        results[i] = std::move(recorded.result);
        progress.step();
    });
    for (const auto& result : results) {
        seen.split += result.split;
        for (const auto& [reason, count] : result.refused) seen.refused[reason] += count;
    }
    return seen;
}

}  // namespace salma::apps
