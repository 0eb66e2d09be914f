// SPDX-License-Identifier: BSD-3-Clause
#include "TDetector.h"

#include <salma/saliency/CAffineSaliency.h>
#include <salma/saliency/CGreedyClusterer.h>
#include <salma/saliency/CKadirClusterer.h>
#include <salma/saliency/CScaleSaliency.h>
#include <salma/saliency/CStableRegions.h>

#include <algorithm>
#include <opencv2/features2d.hpp>
#include <tuple>

namespace salma::bench {
namespace {

using saliency::TEllipse;
using Regions = TDetector::Regions;
using TMost = std::optional<std::size_t>;

/// Steps that halve the range of a threshold.
constexpr int kBisections = 14;

template <class CLUSTERER>
std::vector<observations::TSalientRegion> findDiscs(const cv::Mat& grey, TMost most) {
    auto discs = CLUSTERER().cluster(saliency::CScaleSaliency().detect(grey)).regions;
    if (most && discs.size() > *most) discs.resize(*most);
    return discs;
}

template <class CLUSTERER>
Regions findSalient(const cv::Mat& grey, TMost most) {
    Regions regions;
    for (const auto& disc : findDiscs<CLUSTERER>(grey, most))
        regions.push_back(saliency::ellipseOf(disc));
    return regions;
}

Regions findAffine(const cv::Mat& grey, TMost most) {
    Regions regions;
    for (const auto& region : saliency::CAffineSaliency()
                                  .adapt(grey, findDiscs<saliency::CGreedyClusterer>(grey, most))
                                  .regions)
        regions.push_back(region.ellipse);
    return regions;
}

Regions findStable(const cv::Mat& grey, const saliency::TStableRegionsOptions& options) {
    Regions regions;
    for (const auto& region : saliency::CStableRegions(options).detect(grey))
        regions.push_back(region.ellipse);
    return regions;
}

/// Adds those of `others` that are not there yet, the largest first, up to a number.
void fill(Regions& regions, Regions others, std::size_t most) {
    const auto key = [](const TEllipse& e) {
        return std::make_tuple(-e.radius(), e.v, e.u, e.a, e.b, e.c);
    };
    const auto less = [&](const TEllipse& a, const TEllipse& b) { return key(a) < key(b); };
    Regions known = regions;
    std::sort(known.begin(), known.end(), less);
    std::sort(others.begin(), others.end(), less);
    for (const auto& region : others) {
        if (regions.size() >= most) return;
        if (!std::binary_search(known.begin(), known.end(), region, less))
            regions.push_back(region);
    }
}

Regions findMostStable(const cv::Mat& grey, TMost most) {
    saliency::TStableRegionsOptions options;
    Regions tooMany = findStable(grey, options);
    if (!most || tooMany.size() <= *most) return tooMany;
    Regions few;
    double low = 0;
    double high = options.maxVariation;
    for (int i = 0; i < kBisections; ++i) {
        options.maxVariation = (low + high) / 2;
        Regions found = findStable(grey, options);
        const bool isFew = found.size() <= *most;
        (isFew ? low : high) = options.maxVariation;
        (isFew ? few : tooMany) = std::move(found);
    }
    fill(few, std::move(tooMany), *most);  // of regions that change as much
    return few;
}

Regions findSift(const cv::Mat& grey, TMost most) {
    std::vector<cv::KeyPoint> points;
    cv::SIFT::create()->detect(grey, points);
    const auto key = [](const cv::KeyPoint& p) {
        return std::make_tuple(-p.response, p.pt.y, p.pt.x, p.size);
    };
    std::sort(points.begin(), points.end(),
              [&](const auto& a, const auto& b) { return key(a) < key(b); });
    const auto end = std::unique(points.begin(), points.end(),
                                 [&](const auto& a, const auto& b) { return key(a) == key(b); });
    Regions regions;
    for (auto p = points.begin(); p != end; ++p) {
        const double a = 4.0 / (static_cast<double>(p->size) * p->size);
        regions.push_back({p->pt.x, p->pt.y, a, 0, a});
    }
    if (most && regions.size() > *most) regions.resize(*most);
    return regions;
}

}  // namespace

std::vector<TDetector> allDetectors() {
    return {{"salient", "circular salient regions, greedily clustered; strongest by Y", 3,
             findSalient<saliency::CGreedyClusterer>},
            {"kadir", "the same, clustered as Kadir and Brady do", 3,
             findSalient<saliency::CKadirClusterer>},
            {"affine", "those of salient, each adapted to an ellipse", 3, findAffine},
            {"mser", "maximally stable regions of both polarities, cv::MSER", 3, findMostStable},
            {"sift", "cv::SIFT keypoints, circles of radius sigma; strongest by contrast", 6,
             findSift}};
}

}  // namespace salma::bench
