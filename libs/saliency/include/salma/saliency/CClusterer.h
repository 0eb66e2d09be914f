// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/observations/TSalientRegion.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace salma::saliency {

enum class EClustering { greedy, kadir };

/// Section [clustering].
struct TClusteringOptions : public config::TStrictOptions<TClusteringOptions> {
    EClustering method{EClustering::greedy};
    double wMin{0.5};       //!< Inter-scale saliency a peak must exceed.
    int neighbours{10};     //!< Peaks of a cluster, itself among them (kadir).
    double maxVariance{2};  //!< Of their places in (x, y, s) about their mean [px^2] (kadir).

    void visit(config::COptionVisitor& v);
};

struct TClusteredRegions {
    std::vector<observations::TSalientRegion> regions;  //!< Most salient first.
    std::size_t belowWMin{0};       //!< Peaks dropped for W <= w_min (or not a number).
    std::size_t scattered{0};       //!< Peaks whose neighbours lie too far apart (kadir).
    std::size_t insideStronger{0};  //!< Peaks dropped for lying within or near a stronger region.
};

/** Thins out entropy peaks, of which there are many about each salient place. The more salient peak
 * comes first; of equal ones, by row, column, scale, so that the order of the peaks does not
 * matter. Const is safe from several threads. */
class CClusterer {
 public:
    virtual ~CClusterer() = default;

    /// \throw std::invalid_argument if a position, scale or Y is not finite, or a place beyond 1e9
    /// px.
    virtual TClusteredRegions cluster(
        const std::vector<observations::TSalientRegion>& peaks) const = 0;
};

/// The clusterer that `options.method` names. \throw std::invalid_argument for bad options.
std::unique_ptr<CClusterer> createClusterer(const TClusteringOptions& options);

}  // namespace salma::saliency
