// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CClusterer.h>

#include <vector>

namespace salma::bench {

using TRegions = std::vector<observations::TSalientRegion>;

/// The loop that one writes first: sort, then compare each peak with all regions so far.
TRegions plainGreedy(TRegions peaks, const saliency::TClusteringOptions& options);

/// Kadir's clustering with every distance computed for every peak.
TRegions plainKadir(TRegions peaks, const saliency::TClusteringOptions& options);

/// The same with OpenCV's FLANN (an exact kd-tree) for the neighbours. Of equally far peaks it
/// takes any, so that some regions differ.
TRegions flannKadir(TRegions peaks, const saliency::TClusteringOptions& options);

}  // namespace salma::bench
