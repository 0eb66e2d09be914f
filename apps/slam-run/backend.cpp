// SPDX-License-Identifier: BSD-3-Clause
#include "backend.h"

#include <salma/appearance/CPatchMatcher.h>
#include <salma/slam/CSalientEKF2D.h>
#include <salma/slam/CSalientEKF3D.h>
#include <salma/slam/CSalientRBPF2D.h>

#include <stdexcept>
#include <utility>

namespace salma::apps {
namespace {

using association::EMethod;

const std::vector<std::pair<std::string, EBackend>> kBackends = {{"ekf", EBackend::ekf},
                                                                 {"rbpf", EBackend::rbpf}};
const std::vector<std::pair<std::string, EMethod>> kMethods = {{"nn", EMethod::nn},
                                                               {"scnn", EMethod::scnn},
                                                               {"jcbb", EMethod::jcbb},
                                                               {"saliency", EMethod::saliency}};

template <class ENUM>
ENUM valueOf(const std::string& name, const std::vector<std::pair<std::string, ENUM>>& all) {
    for (const auto& [known, value] : all)
        if (known == name) return value;
    throw std::invalid_argument("'" + name + "' is not known");
}

template <class ENUM>
std::vector<std::string> namesOf(const std::vector<std::pair<std::string, ENUM>>& all) {
    std::vector<std::string> names;
    for (const auto& entry : all) names.push_back(entry.first);
    return names;
}

/// What a landmark is does not depend on the filter: the particles take the keys of [ekf] for it.
slam::TLandmarkMapOptions landmarkMapOf(const TSlamConfig& config) {
    slam::TLandmarkMapOptions options;
    options.ignoreIdentities = config.ekf.ignoreIdentities;
    options.minSightingsCorner = config.ekf.minSightingsCorner;
    options.provisionalSteps = config.ekf.provisionalSteps;
    options.maxPatches = config.ekf.maxPatches;
    options.patchSpread = config.ekf.patchSpread;
    options.decorrelation = config.ekf.decorrelation;
    options.trackGap = config.ekf.trackGap;
    options.headingSigma = config.rbpf.headingSigma;
    return options;
}

}  // namespace

std::unique_ptr<slam::CSlamBackend> createBackend(const TSlamConfig& config) {
    if (config.run.backend == EBackend::rbpf) {
        const slam::TLandmarkMapSetup maps{landmarkMapOf(config), config.association,
                                           config.matcher, config.regionMatcher,
                                           config.rangeBearing};
        return std::make_unique<slam::CSalientRBPF2D>(config.rbpf, maps);
    }
    if (config.ekf.state == slam::EState::space)
        return std::make_unique<slam::CSalientEKF3D>(config.ekf, config.association);
    const auto matcher =
        std::make_shared<const appearance::CPatchMatcher>(config.matcher, config.regionMatcher);
    return std::make_unique<slam::CSalientEKF2D>(
        config.ekf, config.association,
        [matcher](const observations::TPatch& a, const observations::TPatch& b) {
            return matcher->match(a, b).logLikelihoodRatio;
        },
        config.tracking, slam::TMapCare{config.detection, config.relocation, config.slip});
}

std::vector<std::string> backendNames() { return namesOf(kBackends); }
std::vector<std::string> methodNames() { return namesOf(kMethods); }

void setBackend(const std::string& name, TSlamConfig& config) {
    config.run.backend = valueOf(name, kBackends);
}

void setMethod(const std::string& name, TSlamConfig& config) {
    config.association.method = valueOf(name, kMethods);
}

void setSeed(int seed, TSlamConfig& config) { config.lines.seed = config.rbpf.seed = seed; }

}  // namespace salma::apps
