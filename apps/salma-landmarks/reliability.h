// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <proportion.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace salma::apps {

/// A pair whose truth is known, with what a table said of it.
struct TJudgedPair {
    double logRatio{0};
    bool same{false};
    std::string textureA, textureB;
};

/// A value with its 95 % interval.
struct TFigure {
    double value{0}, low{0}, high{0};
};

/// Pairs whose predicted log ratios lie near each other.
struct TReliabilityBin {
    std::size_t same{0}, other{0};
    double predicted{0};  //!< Mean log ratio, both kinds weighing the same.
    /// Log ratio that was counted, and where it lies by the Clopper-Pearson interval of the share
    /// of the same; infinite where one kind is missing.
    TFigure counted;
};

/// What a table of log likelihood ratios is worth on pairs of known truth.
struct TReliability {
    std::size_t same{0}, other{0};      //!< Pairs.
    std::vector<TReliabilityBin> bins;  //!< With at least one pair, by ascending prediction.
    TFigure areaUnderCurve;             //!< Of the ratio; equal ratios count half.
    TFigure logLoss;                    //!< Mean -log p(truth) [nat]; log 2 for a ratio of 1.
    TFigure calibrationError;           //!< Mean |predicted - counted share of the same|.
};

/** Compares predicted with counted shares.
 *
 * Both kinds weigh the same in all, whatever their numbers: p = LR / (1 + LR). Bins are one nat
 * wide. Intervals of bins count pairs as if they were independent. Those of the figures draw whole
 * pictures anew (bootstrap over textures), which pairs that share views and views that share
 * pictures ask for; they say nothing of what all pictures have in common.
 * \throw std::invalid_argument unless there are pairs of both kinds with finite ratios. */
TReliability reliability(const std::vector<TJudgedPair>& pairs, std::uint32_t seed = 1);

}  // namespace salma::apps
