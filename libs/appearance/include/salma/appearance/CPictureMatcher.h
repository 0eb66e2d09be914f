// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <salma/appearance/CPatchDescriptor.h>
#include <salma/config/TStrictOptions.h>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>
#include <vector>

namespace salma::appearance {

/// Section [picture_matcher], read by `salma-features match`.
struct TPictureMatcherOptions : public config::TStrictOptions<TPictureMatcherOptions> {
    int maxKeypoints{1000};      //!< In each picture, the strongest.
    double ratio{0.8};           //!< Nearest over second nearest descriptor distance.
    double tolerance{4};         //!< Pairs agree on a homography within this [px].
    int minKeypoints{20};        //!< A picture with fewer says nothing.
    int fullScoreMatches{20};    //!< With fewer putative pairs the score cannot reach 1.
    double duplicateRate{0.02};  //!< Share of other planes that look the same.
    double decideSame{2.3};      //!< Log likelihood ratio from which the decision is same.
    double decideOther{-1.5};    //!< Log likelihood ratio up to which it is other.
    std::vector<double> scoreKnots{0, 0.2, 0.4, 0.6, 1};  //!< As [matcher] has them.
    std::vector<double> logLrKnots{-2, -1, 1, 5, 5};

    void visit(config::COptionVisitor& v);
    void validate() const;
};

enum class EDecision { same, other, unknown };

const char* asString(EDecision decision);

struct TPictureMatch {
    double score{0};  //!< Agreeing over putative pairs, in [0, 1].
    double logLikelihoodRatio{0};
    EDecision decision{EDecision::unknown};
    std::size_t putative{0};
    cv::Matx33d homography{cv::Matx33d::eye()};  //!< Pixels of a to pixels of b.
    /// Agreeing pairs: place in a, place in b [px].
    std::vector<std::pair<mrpt::math::TPoint2D, mrpt::math::TPoint2D>> pairs;
};

/** Whether two pictures show the same plane, without a laser.
 *
 * SIFT, ratio and mutual test as for patches; agreement is on one homography, since neither scale
 * nor upright is known. score = agreeing / max(putative, `full_score_matches`); 0 if the homography
 * mirrors or if fewer than 8 pairs agree: chance finds four and a few more.
 * The table was measured on views 1 to 2..6 of three planes (VGG graf and boat, HPatches churchill:
 * 12 of 15 score above 0.6, one 0.44, two, 50 deg and more apart, 0) and on 45 pairs of unlike
 * pictures (all 0). So two sights of one plane from very different sides are called other once in
 * a while: that is what the rectified patches of CPatchMatcher are for.
 * Source: D. Lowe, IJCV 60(2), 2004; cv::findHomography (RANSAC, its generator starts anew with
 * each call, so that results repeat). */
class CPictureMatcher {
 public:
    /// \throw std::invalid_argument if the options contradict each other.
    explicit CPictureMatcher(const TPictureMatcherOptions& options = {});

    /** \param a, b CV_8UC1, any size.
     * \throw std::invalid_argument if the type is another. */
    TPictureMatch match(const cv::Mat& a, const cv::Mat& b) const;

 private:
    TPictureMatcherOptions m_options;
};

}  // namespace salma::appearance
