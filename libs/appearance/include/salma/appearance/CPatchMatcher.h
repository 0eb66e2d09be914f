// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/observations/TPatch.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace salma::appearance {

/// Section [matcher] of config.ini.
struct TMatcherOptions : public config::TStrictOptions<TMatcherOptions> {
    double ratio{0.8};                     //!< Nearest over second nearest descriptor distance.
    double scaleTolerance{1.3};            //!< Patches agree in scale within this factor, > 1.
    double rotationTolerance{0.26};        //!< They agree in rotation within this [rad].
    double positionTolerance{0.04};        //!< Matches agree on the shift within this [m].
    int minMatches{4};                     //!< Fewer consistent matches score 0.
    int fullScoreKeypoints{20};            //!< A patch with fewer keypoints cannot score 1.
    double duplicateRate{0.02};            //!< Share of other entities that look the same.
    std::vector<double> scoreKnots{0, 1};  //!< Scores, ascending from 0 to 1.
    std::vector<double> logLrKnots{0, 0};  //!< log p(score|same)/p(score|other) at each.

    void visit(config::COptionVisitor& v);
    void validate() const;
};

/// Rotation, scale and shift that map patch a to patch b: x_b = scale R(rotation) x_a + (tx, ty).
struct TSimilarity {
    double scale{1};
    double rotation{0};   //!< [rad]
    double tx{0}, ty{0};  //!< [m]
};

/// How much two patches look like the same piece of wall.
struct TPatchMatch {
    double score{0};               //!< In [0, 1].
    double logLikelihoodRatio{0};  //!< log p(score | same entity) / p(score | another one).
    std::size_t putative{0};       //!< Keypoints that passed ratio test and mutual test.
    std::size_t consistent{0};     //!< Of these, agreeing on `similarity`.
    TSimilarity similarity;        //!< Only meaningful if `consistent` is not 0.
    std::vector<std::pair<std::size_t, std::size_t>> pairs;  //!< The consistent: index in a, in b.
};

/** Compares the keypoints of two patches.
 *
 * Ratio test and mutual nearest neighbours, then agreement on one similarity whose scale is near 1
 * and whose rotation is near 0, since patches are metric and upright.
 * score = consistent / max(smaller keypoint count, `full_score_keypoints`), 0 below `min_matches`.
 * A patch with fewer than `min_matches` keypoints says nothing: score 0, log likelihood ratio 0.
 * Source: D. Lowe, IJCV 60(2), 2004 (ratio test); agreement: own. */
class CPatchMatcher {
 public:
    /// \throw std::invalid_argument if the options contradict each other.
    explicit CPatchMatcher(const TMatcherOptions& options = {});

    TPatchMatch match(const observations::TPatch& a, const observations::TPatch& b) const;

    /// The table: monotone, piecewise linear, at most -log(duplicate_rate).
    double logLikelihoodRatio(double score) const;

    const TMatcherOptions& options() const { return m_options; }

 private:
    TMatcherOptions m_options;
};

}  // namespace salma::appearance
