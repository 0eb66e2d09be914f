// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <salma/observations/CLogWriter.h>

#include <algorithm>
#include <stdexcept>

#include "CLogSink.h"
#include "nearestFrames.h"
#include "rawObjects.h"

using mrpt::obs::CObservation;
using mrpt::obs::CSensoryFrame;

namespace salma::observations {
namespace {

bool isRecord(const CObservation::Ptr& observation) {
    return std::dynamic_pointer_cast<CObservationSalientLandmarks>(observation) != nullptr;
}

/// What takes its place among others by time; what has no stamp goes first.
void sortByTime(TFrame& observations) {
    std::stable_sort(observations.begin(), observations.end(),
                     [](const auto& a, const auto& b) { return timeOf(*a) < timeOf(*b); });
}

/// All observations of a file, also those inside of frames, but for salient landmarks.
TFrame othersOf(const std::vector<mrpt::serialization::CSerializable::Ptr>& objects) {
    TFrame others;
    const auto add = [&others](const CObservation::Ptr& observation) {
        if (observation && !isRecord(observation)) others.push_back(observation);
    };
    for (const auto& object : objects) {
        add(std::dynamic_pointer_cast<CObservation>(object));
        if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object))
            for (const auto& observation : *frame) add(observation);
    }
    return others;
}

/// The records and what else belongs into a companion, in order of time.
TFrame companionContent(const TLog& log, const TSalientRecords& records) {
    TFrame content;
    if (!log.companionFile.empty())
        content = othersOf(readObjects(log.companionFile, log.truncated).objects);
    for (const auto& record : records) {
        if (!record) throw std::invalid_argument("an empty record cannot be written");
        content.push_back(record);
    }
    sortByTime(content);
    return content;
}

/// The frame without salient landmarks and empty entries.
TFrame keptOf(const CSensoryFrame& frame) {
    TFrame kept;
    for (const auto& observation : frame)
        if (observation && !isRecord(observation)) kept.push_back(observation);
    return kept;
}

/// \pre There is a frame among `objects`.
void writeFrames(CLogSink& sink,
                 const std::vector<mrpt::serialization::CSerializable::Ptr>& objects,
                 const TFrame& more) {
    std::vector<TFrame> frames;
    for (const auto& object : objects)
        if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object))
            frames.push_back(keptOf(*frame));
    const std::vector<std::size_t> places = nearestFrames(frames, more);
    for (std::size_t i = 0; i < more.size(); ++i) frames[places[i]].push_back(more[i]);
    std::size_t next = 0;
    for (const auto& object : objects) {
        if (!std::dynamic_pointer_cast<CSensoryFrame>(object)) {
            const auto observation = std::dynamic_pointer_cast<CObservation>(object);
            if (!isRecord(observation)) sink << *object;
            continue;
        }
        CSensoryFrame filled;
        for (const auto& observation : frames[next++]) filled.insert(observation);
        sink << filled;
    }
}

}  // namespace

void saveCompanion(const TLog& log, const TSalientRecords& records, const std::string& file) {
    const TFrame content = companionContent(log, records);
    CLogSink sink(file);
    for (const auto& observation : content) sink << *observation;
    sink.publish();
}

void saveEmbedded(const TLog& log, const TSalientRecords& records, const std::string& file) {
    const TRawObjects raw = readObjects(log.file, log.truncated);
    TFrame content = companionContent(log, records);
    CLogSink sink(file);
    const bool frames = std::any_of(raw.objects.begin(), raw.objects.end(), [](const auto& object) {
        return std::dynamic_pointer_cast<CSensoryFrame>(object) != nullptr;
    });
    if (frames) {
        writeFrames(sink, raw.objects, content);
    } else {
        const TFrame others = othersOf(raw.objects);
        content.insert(content.begin(), others.begin(), others.end());
        sortByTime(content);
        for (const auto& observation : content) sink << *observation;
    }
    sink.publish();
}

}  // namespace salma::observations
