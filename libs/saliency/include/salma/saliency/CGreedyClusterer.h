// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CClusterer.h>

namespace salma::saliency {

/** The most salient peak deletes all others whose centre lies within its radius, then the most
 * salient of the rest, and so on. Uses w_min only.
 * Source: own short form of the clustering in Kadir and Brady, IJCV 45(2), 2001. */
class CGreedyClusterer : public CClusterer {
 public:
    explicit CGreedyClusterer(const TClusteringOptions& options = {});

    TClusteredRegions cluster(
        const std::vector<observations::TSalientRegion>& peaks) const override;

    const TClusteringOptions& options() const { return m_options; }

 private:
    TClusteringOptions m_options;
};

}  // namespace salma::saliency
