// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/saliency/TEllipse.h>

#include <cstddef>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

namespace salma::saliency {

/// The defaults are those of the survey.
struct TRepeatabilityOptions : public config::TStrictOptions<TRepeatabilityOptions> {
    double maxOverlapError{0.4};  //!< Corresponding regions overlap with a smaller error.
    double normalisedRadius{30};  //!< Radius to which regions are brought before [px].
    double windowScale{3};        //!< From a region to the window of its descriptor.

    void visit(config::COptionVisitor& v);
};

/// The regions of one picture.
struct TRegionView {
    std::vector<TEllipse> regions;
    cv::Size picture;  //!< [px]
};

struct TCorrespondence {
    std::size_t first{0};   //!< Index into the first picture's regions.
    std::size_t second{0};  //!< Index into the second picture's.
    double overlapError{0};
};

struct TRepeatability {
    std::size_t firstCommon{0};   //!< Regions of the first picture that both pictures show whole.
    std::size_t secondCommon{0};  //!< The same of the second.
    std::vector<TCorrespondence> correspondences;  //!< Best first; a region has at most one.
    double firstNonRedundant{0};   //!< nonRedundantCount() of the first picture's common regions.
    double secondNonRedundant{0};  //!< The same of the second.
    double nonRedundantCorrespondences{0};  //!< nonRedundantCount() of the first picture's regions
                                            //!< that correspond to one of the second.

    /// Correspondences by the smaller number of common regions; 0 if there are none.
    double rate() const;
    /// The same with nonRedundantCorrespondences.
    double nonRedundantRate() const;
};

/** Whether a detector finds the same regions in two pictures of one plane.
 *
 * A region counts if it lies whole within both pictures. Those of the second picture are mapped
 * into the first. Both regions of a pair are then enlarged by the factor that gives the first one
 * the normalised radius, each about its own centre: the distance of the centres stays. (Were it
 * enlarged too, nothing would change.) A pair corresponds if its overlap error is small and its
 * centres are closer than four radii of the first region; pairs are taken best first, one to one.
 * Source: K. Mikolajczyk et al., "A comparison of affine region detectors", IJCV 65, 2005, and the
 * program published with it (four radii, distances); I. Rey-Otero et al., ICIP 2015, for the
 * non-redundant figures. */
class CRepeatability {
 public:
    /// \throw std::invalid_argument
    explicit CRepeatability(const TRepeatabilityOptions& options = {});

    /** \param H_2_1 Maps pixels of the first picture to pixels of the second.
     * \throw std::invalid_argument if H_2_1 is singular or not finite. */
    TRepeatability compare(const TRegionView& first,
                           const TRegionView& second,
                           const cv::Matx33d& H_2_1) const;

    const TRepeatabilityOptions& options() const { return m_options; }

 private:
    std::vector<TCorrespondence> overlapping(const std::vector<TEllipse>& first,
                                             const std::vector<TEllipse>& second) const;

    TRepeatabilityOptions m_options;
};

}  // namespace salma::saliency
