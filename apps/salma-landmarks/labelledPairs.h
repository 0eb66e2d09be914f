// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CPatchMatcher.h>

#include <string>
#include <vector>

#include "labelledRun.h"

namespace salma::apps {

enum class EPair {
    same,      //!< One poster, seen twice.
    other,     //!< Two posters that show different things.
    duplicate  //!< Two prints of one picture in two places.
};

/// Two sightings of one run, compared.
struct TLabelledPair {
    EPair kind{EPair::same};
    std::size_t a{0}, b{0};  //!< Sightings of the run, a before b.
    std::string textureA, textureB;
    appearance::EEvidence evidence{appearance::EEvidence::none};
    double score{0};            //!< That the table of the evidence is for.
    double keypointScore{0};    //!< Also where regions were compared.
    double configuredRatio{0};  //!< Log likelihood ratio by the tables of the configuration.
};

/// All pairs of sightings of a run, sorted by a, then b; the same for any number of threads.
std::vector<TLabelledPair> comparePairs(const TLabelledRun& run,
                                        const appearance::CPatchMatcher& matcher,
                                        int threads);

}  // namespace salma::apps
