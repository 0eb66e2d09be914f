// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <salma/config/TStrictOptions.h>
#include <salma/observations/TPatch.h>

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace salma::appearance {

/// Section [region_matcher] of config.ini.
struct TRegionMatchOptions : public config::TStrictOptions<TRegionMatchOptions> {
    double placeSigma{0.006};       //!< Noise of a region's centre between two views [m] ...
    double placeSigmaScales{0.15};  //!< ... and this, times its radius.
    double logScaleSigma{0.15};     //!< Noise of the logarithm of a radius.
    double gateQuantile{0.99};      //!< Probability that a true pair passes the gate.
    double maxShift{0.1};           //!< Largest common shift of two patches, along each axis [m].
    double strong{0.4};             //!< This share of a patch's regions, the most salient, counts.
    double correlation{0.75};       //!< From which two regions look alike.
    double support{0.25};           //!< Share that must look alike before place alone counts.
    double sameExtent{0.6};         //!< Common over larger area, from which regions are compared.

    void visit(config::COptionVisitor& v);
};

/// Section [matcher] of config.ini.
struct TMatcherOptions : public config::TStrictOptions<TMatcherOptions> {
    double ratio{0.8};           //!< Nearest over second nearest descriptor distance.
    double scaleTolerance{1.3};  //!< Patches agree in scale within this factor, > 1.
    double rotationTolerance{mrpt::DEG2RAD(15.0)};  //!< They agree in rotation within this [rad].
    double positionTolerance{0.04};                 //!< Matches agree on the shift within this [m].
    int minMatches{4};                              //!< Fewer consistent matches score 0.
    int fullScoreKeypoints{20};       //!< A patch with fewer keypoints cannot score 1.
    double regionsSameView{0.5};      //!< Region score from which regions agree, seen alike ...
    double regionsOppositeView{0.4};  //!< ... and seen from directions 130 deg apart.
    double duplicateRate{0.05};       //!< Share of other entities that look the same.
    /// Scores, ascending from 0 to 1, and log p(score|same)/p(score|other) at each, as
    /// `salma-landmarks calibrate` learned them: share/calibration.ini.
    std::vector<double> scoreKnots{0,     0.025, 0.075, 0.125, 0.175, 0.225, 0.275, 0.325, 0.375,
                                   0.425, 0.475, 0.525, 0.575, 0.625, 0.675, 0.725, 1};
    std::vector<double> logLrKnots{-2.93, -2.93, -2.75, -2.41, -2.3, -2.3, -0.63, -0.24, 1.39,
                                   2.04,  2.52,  3.16,  3.67,  4.1,  4.68, 5.05,  5.05};
    /// The same for patches without regions.
    std::vector<double> keypointScoreKnots{0,     0.025, 0.075, 0.125, 0.175, 0.225, 0.275, 0.325,
                                           0.375, 0.425, 0.475, 0.525, 0.575, 0.625, 1};
    std::vector<double> keypointLogLrKnots{-2.81, -2.81, 1.03, 1.27, 1.34, 2.79, 2.91, 3.18,
                                           3.18,  3.41,  3.86, 4.41, 4.61, 4.67, 4.67};

    void visit(config::COptionVisitor& v);
    void validate() const;
};

/// Rotation, scale and shift that map patch a to patch b: x_b = scale R(rotation) x_a + (tx, ty).
struct TSimilarity {
    double scale{1};
    double rotation{0};   //!< [rad]
    double tx{0}, ty{0};  //!< [m]
};

/** Where patch a lies on patch b: the same wall, so in two dimensions. Coordinates are those of the
 * patch frames p (u right, v up, origin at the centre of each rectangle). */
struct TRelativePose {
    TSimilarity similarity;  //!< From the frame of a to that of b.
    /// Of (tx, ty, rotation, log scale) [m, m, rad, -], from the spread of the pairs about the fit,
    /// and from the poses' covariances, whose errors all pairs of a patch share.
    Eigen::Matrix4d covariance{Eigen::Matrix4d::Zero()};
    std::size_t pairs{0};  //!< Pairs that it rests on.
};

/// What a log likelihood ratio was read from.
enum class EEvidence {
    none,       //!< Too few keypoints: the ratio is 1.
    keypoints,  //!< The keypoint score and its table.
    both        //!< The mean of both scores and its table.
};

/// How much two patches look like the same piece of wall.
struct TPatchMatch {
    double score{0};               //!< In [0, 1]: mean of both scores, or the keypoints' alone.
    double logLikelihoodRatio{0};  //!< log p(score | same entity) / p(score | another one).
    EEvidence evidence{EEvidence::none};
    double keypointScore{0};   //!< In [0, 1].
    double regionScore{0};     //!< In [0, 1].
    bool regionsAgree{false};  //!< The region score is above what the two views demand.
    double viewDifference{0};  //!< Between the directions of the two views [rad].
    /// Hellinger distance of the walls around, [0, 1]; nothing if one is not described. It does not
    /// enter the ratio: most posters of a building hang on the same wall.
    std::optional<double> textureDistance;
    std::size_t putative{0};  //!< Keypoints that passed ratio test and mutual test.
    std::vector<std::pair<std::size_t, std::size_t>> keypoints;  //!< Agreeing: index in a, in b.
    std::vector<std::pair<std::size_t, std::size_t>> regions;    //!< Matched: index in a, in b.
    /// From the keypoints if they score, else from the regions if those agree.
    std::optional<TRelativePose> relative;
};

/** Compares the keypoints and the salient regions of two patches.
 *
 * Keypoints: ratio test and mutual nearest neighbours, then agreement on one similarity whose scale
 * is near 1 and whose rotation is near 0, since patches are metric and upright.
 * Score = agreeing / max(smaller keypoint count, `full_score_keypoints`), 0 below `min_matches`.
 * Regions: pairs by Mahalanobis distance of (x, y, log s) after the best common shift, one to one;
 * score = matches / mean count, each over the most salient regions. Regions agree from a score on
 * that falls with the angle between the two views.
 * Where both patches have `full_score_keypoints` or more, the score is at most 0.2 + 2 keypoint
 * scores, however well the regions agree: layouts repeat, details do not.
 * Without regions, or if the extents of the patches differ much, keypoints alone decide.
 * A patch with fewer than `min_matches` keypoints, or whose pose or covariance is not finite, says
 * nothing: log likelihood ratio 0. No result is ever NaN.
 *
 * How the tables were measured, and what they are worth: docs/recognition.md.
 * Source: D. Lowe, IJCV 60(2), 2004 (ratio test); K.-L. Ho, transfer report, Oxford 2004, section
 * 4.6 (regions); agreement and correlation of what regions show: own. */
class CPatchMatcher {
 public:
    /// \throw std::invalid_argument if the options contradict each other.
    explicit CPatchMatcher(const TMatcherOptions& options = {},
                           const TRegionMatchOptions& regionOptions = {});

    TPatchMatch match(const observations::TPatch& a, const observations::TPatch& b) const;

    /// The table of the evidence: monotone, piecewise linear, at most -log(duplicate_rate).
    double logLikelihoodRatio(double score, EEvidence evidence = EEvidence::both) const;

    const TMatcherOptions& options() const { return m_options; }

 private:
    void matchKeypointsOf(const observations::TPatch& a,
                          const observations::TPatch& b,
                          TPatchMatch& out) const;
    void matchRegionsOf(const observations::TPatch& a,
                        const observations::TPatch& b,
                        TPatchMatch& out) const;

    TMatcherOptions m_options;
    TRegionMatchOptions m_regionOptions;
};

/** True if a patch holds enough to be recognised: `minKeypoints`, or half of them and as many
 * regions. Small and slanting views leave few keypoints, but regions are sought at all scales of
 * the wall. */
bool saysEnough(const observations::TPatch& patch, std::size_t minKeypoints);

}  // namespace salma::appearance
