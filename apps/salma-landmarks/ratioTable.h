// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "TCalibrationOptions.h"

namespace salma::apps {

struct TRatioBin {
    double from{0}, to{0};          //!< Scores in [from, to); the last bin holds 1 as well.
    std::size_t same{0}, other{0};  //!< Pairs.
    double counted{0};              //!< Log ratio of this bin alone, with the prior count.
    double logRatio{0};             //!< What the monotone table makes of it.
};

/// log p(score|same) / p(score|other) as `[matcher]` holds it.
struct TRatioTable {
    std::vector<TRatioBin> bins;
    std::vector<double> scoreKnots;  //!< Ascending from 0 to 1.
    std::vector<double> logLrKnots;  //!< Not descending.
};

/// How many independent pairs the scores are worth.
struct TIndependent {
    double same{0}, other{0};
};

/** Learns a monotone table of the log likelihood ratio from scores.
 *
 * Pairs share views and views share posters, so counts are scaled down to the number of independent
 * pairs that the caller states, where they are more. `priorCount` sightings of each kind, spread
 * evenly over the bins, keep empty ones finite. Neighbouring bins whose ratios fall are pooled
 * (pool adjacent violators: the most likely ratios that do not fall). Then a share `spoiltRate` of
 * the same is taken to score like others, so that no ratio is below it: simulated walls know
 * neither glare nor people.
 * Source: M. Ayer et al., Ann. Math. Statist. 26(4), 1955 (pooling);
 * scaling, prior and spoilt share: own.
 * \param same Scores of pairs of one poster, not empty. \param other Of different posters, not
 * empty; all in [0, 1]. \throw std::invalid_argument */
TRatioTable learnTable(const std::vector<double>& same,
                       const std::vector<double>& other,
                       const TIndependent& independent,
                       const TCalibrationOptions& options);

/// Piecewise linear, as the matcher reads it.
double readRatio(const TRatioTable& table, double score);

}  // namespace salma::apps
