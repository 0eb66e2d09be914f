// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CPatchMatcher.h>
#include <salma/landmarks/CLandmarkRecorder.h>
#include <salma/landmarks/CWideBaselineTracker.h>

#include <string>

namespace salma::sensing {

/// What of salma-slam's config.ini concerns seeing, one member a section (`seeing` has several).
struct TSensingConfig {
    landmarks::TRecorderOptions recorder;
    landmarks::TTrackingOptions tracking;
    appearance::TMatcherOptions matcher;
    appearance::TRegionMatchOptions regionMatcher;

    /** Reads a config.ini of salma-slam. Its other sections are not looked into, but those that
     * salma-slam does not know are refused.
     * \throw std::invalid_argument naming file, section, key and value of the first mistake. */
    static TSensingConfig load(const std::string& file);
};

}  // namespace salma::sensing
