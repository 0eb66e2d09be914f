// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>
#include <salma/saliency/TEllipse.h>

#include <cstddef>
#include <vector>

namespace salma::saliency {

/// Section [affine].
struct TAffineOptions : public config::TStrictOptions<TAffineOptions> {
    bool use{false};             //!< For programs: adapt the regions or leave them discs.
    double maxRatio{3};          //!< Largest ratio of an ellipse's axes.
    double elongationCost{0.2};  //!< Y that an ellipse must gain for each unit of log axis ratio.
    int maxSteps{40};            //!< Changes of shape after which the search for one region ends.

    void visit(config::COptionVisitor& v);
};

struct TAffineRegion {
    TEllipse ellipse;  //!< About the disc's centre; radius() is its scale.
    double H{0};       //!< Entropy in the ellipse [nat, or the detector's base].
    double W{0};       //!< Inter-scale saliency [-].
    double Y{0};       //!< Saliency, H times W.
};

struct TAffineRegions {
    std::vector<TAffineRegion> regions;  //!< One for each disc, in the order of the discs.
    std::size_t withoutPeak{0};   //!< Discs left as given: no ellipse near has an entropy peak, or
                                  //!< all leave the picture.
    std::size_t notConverged{0};  //!< Ellipses that were still changing after the last step.
};

/** Turns salient discs into ellipses that fit what is around their centres.
 *
 * H and W are CScaleSaliency's, with discs of radius s replaced by ellipses of one shape (axis
 * ratio, angle) whose half axes have the geometric mean s. From the disc on, the shape changes in
 * ever smaller steps for as long as Y at the entropy peak near the present scale grows; the scale
 * follows the peak, up to twice or half of the disc's. Small windows are sampled finer than the
 * picture (bilinear), else thin rings would hold too few pixels; their H, W and Y differ a little
 * from the detector's.
 * Source: T. Kadir, A. Zisserman and M. Brady, "An affine invariant salient region detector",
 * ECCV 2004, where the shape maximises W in turn with the scale, which is a peak of H;
 * sampling, step rule and cost of elongation are own. */
class CAffineSaliency {
 public:
    /// \param saliency Of the detector that found the discs. \throw std::invalid_argument
    explicit CAffineSaliency(const TAffineOptions& options = {},
                             const TScaleSaliencyOptions& saliency = {});

    /** \param grey Picture [rows x cols], CV_8UC1. \param discs As the detector or a clusterer
     * gives them. \throw std::invalid_argument for another type of picture, or naming a disc whose
     * scale is not positive or whose centre is not in the picture. */
    TAffineRegions adapt(const cv::Mat& grey,
                         const std::vector<observations::TSalientRegion>& discs) const;

    const TAffineOptions& options() const { return m_options; }

 private:
    TAffineOptions m_options;
    TScaleSaliencyOptions m_saliency;
};

/// Centre, mean radius, H, W and Y of an ellipse.
observations::TSalientRegion asDisc(const TAffineRegion& region);

}  // namespace salma::saliency
