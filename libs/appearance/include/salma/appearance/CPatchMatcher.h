// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <salma/config/TStrictOptions.h>
#include <salma/observations/TPatch.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace salma::appearance {

/// Section [matcher] of config.ini.
struct TMatcherOptions : public config::TStrictOptions<TMatcherOptions> {
    double ratio{0.8};           //!< Nearest over second nearest descriptor distance.
    double scaleTolerance{1.3};  //!< Patches agree in scale within this factor, > 1.
    double rotationTolerance{mrpt::DEG2RAD(15.0)};  //!< They agree in rotation within this [rad].
    double positionTolerance{0.04};                 //!< Matches agree on the shift within this [m].
    int minMatches{4};                              //!< Fewer consistent matches score 0.
    int fullScoreKeypoints{20};  //!< A patch with fewer keypoints cannot score 1.
    double duplicateRate{0.02};  //!< Share of other entities that look the same.
    std::vector<double> scoreKnots{0, 0.1, 0.2, 0.3, 1};  //!< Scores, ascending from 0 to 1.
    std::vector<double> logLrKnots{-3, 0, 1.4, 5.2,
                                   5.2};  //!< log p(score|same)/p(score|other) at each.

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
 *
 * The default table was measured on ten paintings and photographs, 0.8 m high, rendered on a wall
 * from 1 to 6 m and up to 65 deg to either side, with blur up to 1.5 px, noise of 2 to 6 grey
 * levels, gain 0.6 to 1.2, borders off by 5 cm, and the wall off by 2 cm and 2 deg: 280 pairs of
 * the same, 576 of different ones. Same: 2 % score below 0.2, 10 % below 0.3, none 0. Different:
 * all score 0, so p(score > 0 | other) < 3/576 with 95 %. Five per cent of real views are taken to
 * be spoilt (glare, people in front) and to score 0, hence -3 there. On ten further pictures 0.4 %
 * of the same and all of the different pairs score 0. Source: D. Lowe, IJCV 60(2), 2004 (ratio
 * test); agreement: own. */
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
