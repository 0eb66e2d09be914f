// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/CGreedyClusterer.h>
#include <salma/saliency/CKadirClusterer.h>

namespace salma::saliency {

void TClusteringOptions::visit(config::COptionVisitor& v) {
    v.choice("method", method, {{"greedy", EClustering::greedy}, {"kadir", EClustering::kadir}},
             "the most salient peak deletes those in its disc, or needs peaks like it around");
    v.number("w_min", wMin, config::atLeast(0), "inter-scale saliency that a peak must exceed");
    v.integer("neighbours", neighbours, config::between(1, 1000),
              "peaks of a cluster, itself among them (kadir)");
    v.number("max_variance_px2", maxVariance, config::atLeast(0),
             "variance of their places in column, row and scale, at most (kadir)");
}

std::unique_ptr<CClusterer> createClusterer(const TClusteringOptions& options) {
    if (options.method == EClustering::kadir) return std::make_unique<CKadirClusterer>(options);
    return std::make_unique<CGreedyClusterer>(options);
}

}  // namespace salma::saliency
