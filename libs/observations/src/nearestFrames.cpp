// SPDX-License-Identifier: BSD-3-Clause
#include "nearestFrames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "rawObjects.h"

namespace salma::observations {
namespace {

/// Stamp of an observation and the frame that it stands in; ordered by time, then by frame.
using TStamp = std::pair<double, std::size_t>;

std::vector<TStamp> stampsOf(const std::vector<TFrame>& frames) {
    std::vector<TStamp> stamps;
    for (std::size_t i = 0; i < frames.size(); ++i)
        for (const auto& observation : frames[i])
            if (const auto time = timeOf(*observation)) stamps.emplace_back(*time, i);
    if (stamps.empty()) stamps.emplace_back(0, 0);
    std::sort(stamps.begin(), stamps.end());
    stamps.erase(std::unique(stamps.begin(), stamps.end()), stamps.end());
    return stamps;
}

double nearestStamp(const std::vector<TStamp>& stamps, double time) {
    const auto after = std::lower_bound(stamps.begin(), stamps.end(), TStamp{time, 0});
    if (after == stamps.end()) return stamps.back().first;
    if (after == stamps.begin()) return after->first;
    const double before = std::prev(after)->first;
    return time - before <= after->first - time ? before : after->first;
}

}  // namespace

std::vector<std::size_t> nearestFrames(const std::vector<TFrame>& frames, const TFrame& records) {
    const std::vector<TStamp> stamps = stampsOf(frames);
    std::set<std::pair<std::size_t, std::string>> given;
    std::vector<std::size_t> result;
    for (const auto& record : records) {
        const double time = nearestStamp(stamps, timeOf(*record).value_or(stamps.back().first));
        auto place = std::lower_bound(stamps.begin(), stamps.end(), TStamp{time, 0});
        while (std::next(place) != stamps.end() && std::next(place)->first == time &&
               given.count({place->second, record->sensorLabel}) > 0)
            ++place;
        given.emplace(place->second, record->sensorLabel);
        result.push_back(place->second);
    }
    return result;
}

}  // namespace salma::observations
