// SPDX-License-Identifier: BSD-3-Clause
#include <salma/config/CStrictFile.h>
#include <salma/landmarks/forEachSeeingSection.h>
#include <salma/sensing/TSensingConfig.h>

#include <vector>

namespace salma::sensing {

TSensingConfig TSensingConfig::load(const std::string& file) {
    const auto ini = config::openStrict(file);
    TSensingConfig loaded;
    // Sections about what happens after seeing.
    std::vector<std::string> known{"run",  "corners",   "wall_odometry", "association",
                                   "ekf",  "detection", "relocation",    "slip",
                                   "rbpf", "odometry",  "range_bearing"};
    const auto read = [&](const std::string& section, auto& options) {
        known.push_back(section);
        options.loadFromConfigFile(*ini, section);
    };
    read("lines", loaded.recorder.lines);
    read("place_string", loaded.recorder.placeString);
    landmarks::forEachSeeingSection(loaded.recorder.seeing, read);
    read("matcher", loaded.matcher);
    read("region_matcher", loaded.regionMatcher);
    read("tracking", loaded.tracking);
    config::rejectUnknownSections(*ini, known);
    return loaded;
}

}  // namespace salma::sensing
