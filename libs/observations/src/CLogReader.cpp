// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <salma/observations/CLogReader.h>

#include <filesystem>
#include <stdexcept>

#include "buildSteps.h"
#include "movement.h"
#include "rawObjects.h"

namespace fs = std::filesystem;
using mrpt::obs::CObservation;

namespace salma::observations {
namespace {

constexpr auto kEnding = ".rawlog";

/// X of X.rawlog.
std::string stem(const std::string& rawlog) {
    const fs::path path(rawlog);
    return path.extension() == kEnding ? fs::path(path).replace_extension().string() : rawlog;
}

void count(const CObservation& observation, TLog& log) {
    ++log.counts[observation.GetRuntimeClass()->className];
}

/// Motion of a collection, joined to what collections before it said since the last frame.
void addMovement(const mrpt::obs::CActionCollection& actions,
                 const std::string& file,
                 std::optional<TMovement>& pending) {
    try {
        const auto movement = movementOf(actions);
        if (pending && movement)
            *pending += *movement;
        else if (movement)
            pending = movement;
    } catch (const std::exception&) {  // MRPT's words go on for lines
        throw std::runtime_error(file + ": holds an action that cannot be used");
    }
}

TFrame observationsOf(const mrpt::obs::CSensoryFrame& frame, TLog& log) {
    TFrame observations;
    for (const auto& observation : frame) {
        if (!observation) {
            ++log.dropped["empty entry of a sensory frame"];
            continue;
        }
        count(*observation, log);
        observations.push_back(observation);
    }
    return observations;
}

TLogParts takeApart(const TRawObjects& raw, const std::string& file, TLog& log) {
    TLogParts parts;
    std::optional<TMovement> pending;
    for (const auto& object : raw.objects) {
        if (const auto observation = std::dynamic_pointer_cast<CObservation>(object)) {
            count(*observation, log);
            parts.single.push_back(observation);
        } else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
            parts.frames.push_back(observationsOf(*frame, log));
            parts.increments.push_back(pending);
            pending.reset();
        } else if (const auto actions =
                       std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object)) {
            addMovement(*actions, file, pending);
        }
    }
    parts.actionFormat = !parts.frames.empty();
    return parts;
}

void addCompanion(const TLogReaderOptions& options, TLogParts& parts, TLog& log) {
    const std::string companion = companionOf(log.file);
    if (!options.mergeCompanion || !fs::exists(companion)) return;
    const TRawObjects raw = readObjects(companion, options.acceptTruncated);
    log.companionFile = companion;
    log.truncated = log.truncated || raw.truncated;
    TLogParts more = takeApart(raw, companion, log);
    parts.single.insert(parts.single.end(), more.single.begin(), more.single.end());
    for (const TFrame& frame : more.frames)
        parts.single.insert(parts.single.end(), frame.begin(), frame.end());
}

}  // namespace

std::string companionOf(const std::string& rawlog) { return stem(rawlog) + ".salient" + kEnding; }

TLog readLog(const std::string& file, const TLogReaderOptions& options) {
    TLog log;
    log.file = file;
    log.imagesFolder = stem(file) + "_Images";
    const TRawObjects raw = readObjects(file, options.acceptTruncated);
    log.truncated = raw.truncated;
    log.lastGoodTime = raw.lastGoodTime;
    try {
        TLogParts parts = takeApart(raw, file, log);
        addCompanion(options, parts, log);
        buildSteps(std::move(parts), log);
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(file + ": needs more memory than there is");
    }
    return log;
}

}  // namespace salma::observations
