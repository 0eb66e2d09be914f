// SPDX-License-Identifier: BSD-3-Clause
#include "TSlamConfig.h"

#include <salma/config/CStrictFile.h>
#include <salma/landmarks/forEachSeeingSection.h>

#include <vector>

namespace salma::apps {
namespace {

/// Calls visitor(section name, options) for each section, in the order of config.ini.
template <class CONFIG, class VISITOR>
void forEachSection(CONFIG& c, VISITOR visitor) {
    visitor("run", c.run);
    visitor("lines", c.lines);
    visitor("corners", c.corners);
    visitor("wall_odometry", c.wallOdometry);
    visitor("place_string", c.placeString);
    landmarks::forEachSeeingSection(c.seeing, visitor);
    visitor("matcher", c.matcher);
    visitor("region_matcher", c.regionMatcher);
    visitor("association", c.association);
    visitor("tracking", c.tracking);
    visitor("ekf", c.ekf);
    visitor("detection", c.detection);
    visitor("relocation", c.relocation);
    visitor("slip", c.slip);
    visitor("rbpf", c.rbpf);
    visitor("odometry", c.odometry);
    visitor("range_bearing", c.rangeBearing);
}

}  // namespace

void TRunOptions::visit(config::COptionVisitor& v) {
    v.text("rawlog", rawlog, "log to read if the command line names none, beside this file");
    v.choice("backend", backend, {{"ekf", EBackend::ekf}, {"rbpf", EBackend::rbpf}},
             "extended Kalman filter, or particles with a map each");
    v.integer("threads", threads, config::between(0, 256),
              "for the pictures, 0: one per core; the result does not depend on it");
    v.flag("corners", corners, "laser corners are landmarks");
    v.number("scan_distance_m", scanDistance, config::atLeast(0),
             "a scan is used after this travel");
    v.degrees("scan_turn_deg", scanTurn, config::between(0, 180), "or after this much turning");
    v.number("unknown_motion_m", unknownMotion, config::moreThan(0),
             "without odometry: sigma of the motion in one second");
    v.degrees("unknown_turn_deg", unknownTurn, config::insideOf(0, 360),
              "without odometry: sigma of the turn in one second");
}

TSlamConfig TSlamConfig::load(const std::string& file) {
    const auto ini = config::openStrict(file);
    TSlamConfig loaded;
    std::vector<std::string> known;
    forEachSection(loaded, [&](const std::string& section, auto& options) {
        known.push_back(section);
        options.loadFromConfigFile(*ini, section);
    });
    config::rejectUnknownSections(*ini, known);
    return loaded;
}

std::string TSlamConfig::asIni() const {
    std::string text;
    forEachSection(*this, [&](const std::string& section, const auto& options) {
        text += (text.empty() ? "" : "\n") + options.asIni(section);
    });
    return text;
}

}  // namespace salma::apps
