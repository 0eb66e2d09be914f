// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/CLandmarkMapSetup.h>
#include <salma/slam/CSharedParts.h>

#include <map>
#include <mutex>

namespace salma::slam {
namespace {

constexpr std::size_t kMostRemembered = 100000;

template <class SETUP, class VISITOR>
void forEachSection(SETUP& setup, const std::string& prefix, VISITOR visitor) {
    visitor(prefix + "_insertOpts", setup.map);
    visitor(prefix + "_associationOpts", setup.association);
    visitor(prefix + "_matcherOpts", setup.matcher);
    visitor(prefix + "_regionMatcherOpts", setup.regionMatcher);
    visitor(prefix + "_rangeBearingOpts", setup.rangeBearing);
}

}  // namespace

void TLandmarkMapOptions::visit(config::COptionVisitor& v) {
    v.flag("ignore_identities", ignoreIdentities, "do not read the identities in the log");
    v.integer("min_sightings_corner", minSightingsCorner, config::atLeast(1),
              "steps in which a corner must be seen before it counts as a landmark");
    v.integer("provisional_steps", provisionalSteps, config::atLeast(1),
              "insertions into the map after which a corner seen less often is forgotten");
    v.integer("max_patches", maxPatches, config::atLeast(1),
              "views of a salient landmark that are kept");
    v.degrees("patch_spread_deg", patchSpread, config::between(0, 90),
              "least difference in viewing angle between two kept views");
    v.degrees("heading_sigma_deg", headingSigma, config::between(0, 45),
              "uncertainty of a particle's heading where directions of walls are compared");
    v.degrees("decorrelation_deg", decorrelation, config::between(0, 180),
              "appearance counts again in one track after this change of the viewing angle");
    v.number("track_gap_s", trackGap, config::atLeast(0),
             "a landmark not paired for longer begins another track");
}

void TLandmarkMapSetup::load(const mrpt::config::CConfigFileBase& file, const std::string& prefix) {
    forEachSection(*this, prefix, [&](const std::string& section, auto& options) {
        options.loadFromConfigFile(file, section);
    });
}

std::string TLandmarkMapSetup::asIni(const std::string& prefix) const {
    std::string text;
    forEachSection(*this, prefix, [&](const std::string& section, const auto& options) {
        text += options.asIni(section) + "\n";
    });
    return text;
}

/// Ratios by the numbers of seen and stored patch.
struct CLandmarkMapSetup::TMemory {
    std::mutex mutex;
    std::map<std::pair<std::uint64_t, std::uint64_t>, double> ratios;
};

CLandmarkMapSetup::CLandmarkMapSetup(const TLandmarkMapSetup& options)
    : m_options(options),
      m_associator(association::createAssociator(options.association)),
      m_matcher(options.matcher, options.regionMatcher),
      m_memory(std::make_unique<TMemory>()) {
    m_options.map.validate();
    m_options.rangeBearing.validate();
}

CLandmarkMapSetup::~CLandmarkMapSetup() = default;

double CLandmarkMapSetup::logRatio(const observations::TPatch& seen,
                                   const observations::TPatch& stored) const {
    const auto& patches = CSharedParts<observations::TPatch>::instance();
    const auto key = std::make_pair(patches.numberOf(seen), patches.numberOf(stored));
    const bool memorable = key.first != 0 && key.second != 0;
    if (memorable) {
        const std::lock_guard<std::mutex> lock(m_memory->mutex);
        const auto known = m_memory->ratios.find(key);
        if (known != m_memory->ratios.end()) return known->second;
    }
    const double ratio = m_matcher.match(seen, stored).logLikelihoodRatio;
    if (memorable) {
        const std::lock_guard<std::mutex> lock(m_memory->mutex);
        if (m_memory->ratios.size() >= kMostRemembered) m_memory->ratios.clear();
        m_memory->ratios[key] = ratio;
    }
    return ratio;
}

}  // namespace salma::slam
