// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/observations/TSalientRegion.h>

#include <cstddef>
#include <vector>

namespace salma::saliency {

/// Section [clustering].
struct TClusteringOptions : public config::TStrictOptions<TClusteringOptions> {
    double wMin{0.5};  //!< Inter-scale saliency a peak must exceed.

    void visit(config::COptionVisitor& v);
};

struct TClusteredRegions {
    std::vector<observations::TSalientRegion> regions;  //!< Most salient first.
    std::size_t belowWMin{0};       //!< Peaks dropped for W <= w_min (or not a number).
    std::size_t insideStronger{0};  //!< Peaks dropped for lying within a stronger region.
};

/** Thins out entropy peaks: the most salient one deletes all others whose centre lies within its
 * radius, then the most salient of the rest, and so on.
 * Source: own short form of the clustering in Kadir and Brady, IJCV 45(2), 2001. */
class CGreedyClusterer {
 public:
    explicit CGreedyClusterer(const TClusteringOptions& options = {});

    /** \param peaks In any order, which does not matter: equal Y are taken by row, column, scale.
     * \throw std::invalid_argument if a position or scale is not finite. */
    TClusteredRegions cluster(const std::vector<observations::TSalientRegion>& peaks) const;

    const TClusteringOptions& options() const { return m_options; }

 private:
    TClusteringOptions m_options;
};

}  // namespace salma::saliency
