// SPDX-License-Identifier: BSD-3-Clause
#include "buildSteps.h"

#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <limits>

#include "rawObjects.h"

using mrpt::obs::CObservationOdometry;
using mrpt::poses::CPose2D;

namespace salma::observations {
namespace {

constexpr double kAnySkew = std::numeric_limits<double>::infinity();

struct TSorted {
    std::vector<CObservationOdometry::Ptr> odometry;
    std::vector<CObservationPanTilt::Ptr> heads;
    TFrame others;
};

TSorted sortByKind(const TFrame& observations) {
    TSorted sorted;
    for (const auto& observation : observations) {
        if (auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation))
            sorted.odometry.push_back(odometry);
        else if (auto head = std::dynamic_pointer_cast<CObservationPanTilt>(observation))
            sorted.heads.push_back(head);
        else
            sorted.others.push_back(observation);
    }
    return sorted;
}

template <class RECORD>
bool earlier(const RECORD& a, const RECORD& b) {
    return *timeOf(*a) < *timeOf(*b);
}

template <class RECORD>
void dropStampless(std::vector<RECORD>& records, TLog& log) {
    const auto end = std::remove_if(records.begin(), records.end(),
                                    [](const RECORD& record) { return !timeOf(*record); });
    if (end == records.end()) return;
    log.dropped["without a stamp"] += static_cast<std::size_t>(records.end() - end);
    records.erase(end, records.end());
}

/// Leaves the stamped records of one sensor, in order of time.
template <class RECORD>
void keepOneSensor(std::vector<RECORD>& records, const std::string& kind, TLog& log) {
    dropStampless(records, log);
    if (records.empty()) return;
    const std::string label = records.front()->sensorLabel;
    const auto end = std::remove_if(records.begin(), records.end(), [&](const RECORD& record) {
        if (record->sensorLabel == label) return false;
        ++log.dropped[kind + " of a further sensor: " + record->sensorLabel];
        return true;
    });
    records.erase(end, records.end());
    for (std::size_t i = 1; i < records.size(); ++i)
        log.outOfOrder += earlier(records[i], records[i - 1]) ? 1 : 0;
    std::stable_sort(records.begin(), records.end(), earlier<RECORD>);
}

void fillHeads(std::vector<CObservationPanTilt::Ptr> heads, TLog& log) {
    keepOneSensor(heads, "pan/tilt", log);
    for (const auto& head : heads) log.panTilt.add(head);
}

void fillOdometry(std::vector<CObservationOdometry::Ptr> records, TLog& log) {
    keepOneSensor(records, "odometry", log);
    for (const auto& record : records) log.odometry.add(*timeOf(*record), record->odometry);
    log.hasOdometry = !records.empty();
}

/// Odometry at the time of each step, from TLog::odometry.
void interpolateOdometry(TLog& log) {
    for (TLogStep& step : log.steps)
        step.odometry = log.odometry.at(step.time, kAnySkew).value_or(CPose2D());
}

void buildFromSingle(const TLogParts& parts, TLog& log) {
    TSorted sorted = sortByKind(parts.single);
    fillHeads(sorted.heads, log);
    fillOdometry(sorted.odometry, log);
    dropStampless(sorted.others, log);
    std::stable_sort(sorted.others.begin(), sorted.others.end(),
                     earlier<mrpt::obs::CObservation::Ptr>);
    for (const auto& observation : sorted.others) {
        TLogStep& step = log.steps.emplace_back();
        step.time = *timeOf(*observation);
        step.observations = {observation};
    }
    interpolateOdometry(log);
}

double timeOfFrame(const TFrame& frame, double before) {
    for (const auto& observation : frame)
        if (const auto time = timeOf(*observation)) return *time;
    return before;
}

/// Puts observations from outside of the frames into the frames nearest in time.
void spread(const TFrame& single, std::vector<TFrame>& frames) {
    const std::vector<std::size_t> places = nearestFrames(frames, single);
    for (std::size_t i = 0; i < single.size(); ++i) frames[places[i]].push_back(single[i]);
}

/// Adds up the motions of the actions.
void accumulate(const TLogParts& parts, TLog& log) {
    CPose2D odometry;
    bool increasing = true;
    for (std::size_t i = 0; i < log.steps.size(); ++i) {
        TLogStep& step = log.steps[i];
        if (const auto& movement = parts.increments[i]) {
            step.increment = movement->flat;
            step.spatialIncrement = movement->spatial;
            odometry = odometry + step.increment->mean;
        }
        step.odometry = odometry;
        increasing = increasing && (i == 0 || step.time > log.steps[i - 1].time);
    }
    log.hasOdometry = true;
    if (!increasing) return;
    for (const TLogStep& step : log.steps) log.odometry.add(step.time, step.odometry);
}

bool strictlyIncreasing(const std::vector<CObservationOdometry::Ptr>& records) {
    for (std::size_t i = 0; i < records.size(); ++i) {
        const auto time = timeOf(*records[i]);
        if (!time || (i > 0 && !(*time > *timeOf(*records[i - 1])))) return false;
    }
    return true;
}

/// Odometry from records in the frames, for logs whose actions state no motion.
void takeFromFrames(std::vector<CObservationOdometry::Ptr> records, TLog& log) {
    if (strictlyIncreasing(records)) {
        fillOdometry(std::move(records), log);
        interpolateOdometry(log);
        return;
    }
    // The stamps say nothing, so the order of the frames must do.
    CPose2D last;
    for (TLogStep& step : log.steps) {
        for (const auto& observation : step.observations)
            if (const auto record = std::dynamic_pointer_cast<CObservationOdometry>(observation))
                last = record->odometry;
        step.odometry = last;
    }
    log.hasOdometry = true;
}

void buildFromFrames(TLogParts parts, TLog& log) {
    spread(parts.single, parts.frames);
    TSorted inside;
    double time = 0;
    for (const TFrame& frame : parts.frames) {
        const TSorted sorted = sortByKind(frame);
        inside.heads.insert(inside.heads.end(), sorted.heads.begin(), sorted.heads.end());
        inside.odometry.insert(inside.odometry.end(), sorted.odometry.begin(),
                               sorted.odometry.end());
        TLogStep& step = log.steps.emplace_back();
        step.observations = frame;
        step.time = time = timeOfFrame(frame, time);
    }
    fillHeads(inside.heads, log);
    const bool moved = std::any_of(parts.increments.begin(), parts.increments.end(),
                                   [](const auto& increment) { return increment.has_value(); });
    if (moved)
        accumulate(parts, log);
    else if (!inside.odometry.empty())
        takeFromFrames(std::move(inside.odometry), log);
}

}  // namespace

void buildSteps(TLogParts parts, TLog& log) {
    log.actionFormat = parts.actionFormat;
    if (parts.frames.empty())
        buildFromSingle(parts, log);
    else
        buildFromFrames(std::move(parts), log);
}

}  // namespace salma::observations
