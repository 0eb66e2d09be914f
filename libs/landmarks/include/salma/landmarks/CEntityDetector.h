// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/landmarks/CEntitySelector.h>
#include <salma/saliency/CClusterer.h>
#include <salma/saliency/CExternalDetector.h>
#include <salma/saliency/CQuadrilaterals.h>
#include <salma/saliency/CScaleSaliency.h>
#include <salma/saliency/CStableRegions.h>

#include <memory>
#include <opencv2/core.hpp>

namespace salma::landmarks {

/// The options of all that a picture passes before walls are known.
struct TDetectionOptions {
    TSelectionOptions selection;
    saliency::TScaleSaliencyOptions saliency;
    saliency::TClusteringOptions clustering;
    saliency::TStableRegionsOptions mser;
    saliency::TQuadOptions quad;
    saliency::TExternalOptions external;
};

/** Finds what entities are made of, in a picture alone.
 *
 * - `scale-saliency`: clustered salient regions with Y >= y_min.
 * - `mser`: maximally stable regions, as discs of their area, with the radii that scale saliency
 *   has; each also joins the smaller ones inside it.
 * - `both`: the salient regions, joined where their centres lie in one stable region.
 * - `quad`: closed four-sided contours, each as five points inside it that belong together.
 * - `external`: those of another program, as discs of their area.
 *
 * All give regions and the areas that join them; what follows is the same for each. A picture that
 * is darker than `brightness` is brought to it first: thresholds are in grey levels, and a camera's
 * exposure is not the poster's doing. Const is safe from several threads. */
class CEntityDetector {
 public:
    /// \throw std::invalid_argument if options are out of range.
    explicit CEntityDetector(const TDetectionOptions& options = {});

    /// \param grey CV_8UC1. \throw std::invalid_argument for another type of picture;
    /// std::runtime_error if an external program fails.
    TDetections detect(const cv::Mat& grey) const;

 private:
    std::vector<observations::TSalientRegion> salientRegions(const cv::Mat& grey) const;
    void addStable(const cv::Mat& grey, bool asRegions, TDetections& out) const;
    cv::Mat bright(const cv::Mat& grey) const;
    void addQuads(const cv::Mat& grey, TDetections& out) const;

    EDetector m_detector;
    double m_yMin, m_brightness;
    saliency::CScaleSaliency m_saliency;
    std::shared_ptr<const saliency::CClusterer> m_clusterer;
    saliency::CStableRegions m_stable;
    saliency::CQuadrilaterals m_quads;
    saliency::CExternalDetector m_external;
};

}  // namespace salma::landmarks
