// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CClusterer.h>

namespace salma::saliency {

/** Keeps peaks that others of similar place and scale support. From the most salient peak on: its
 * cluster is the K peaks nearest to it in (x, y, s), itself among them; of equally far ones the
 * more salient. It becomes a region if the variance of their places, (sum of squared distances to
 * their mean) / K, does not exceed the limit, and the mean is farther than its own scale from all
 * regions so far, in (x, y, s). The region has the cluster's mean place and scale and the peak's H,
 * W and Y. A peak stays a neighbour whatever became of it; with less than K peaks there is no
 * region. Source: T. Kadir and M. Brady, "Saliency, scale and image description", IJCV 45(2), 2001,
 * which leaves K and the limit open. */
class CKadirClusterer : public CClusterer {
 public:
    explicit CKadirClusterer(const TClusteringOptions& options = {});

    TClusteredRegions cluster(
        const std::vector<observations::TSalientRegion>& peaks) const override;

    const TClusteringOptions& options() const { return m_options; }

 private:
    TClusteringOptions m_options;
};

}  // namespace salma::saliency
