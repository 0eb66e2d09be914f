// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>

#include <cstdint>
#include <vector>

namespace salma::saliency {

constexpr int kLanes = 64;  // centres that are worked on together

/// A row j of disc(s) outside of its inner square, and how far it reaches to both sides.
struct TDiscRow {
    int j{0};
    int half{0};
};

/** What depends on the options alone. All arrays are indexed by the radius s = 0..sMax [px].
 *
 * disc(s) = {i^2 + j^2 <= s^2} is cut into the square [-m,m]^2 with m = innerSquare[s], the rows
 * m < |j| <= s and, by symmetry, the columns m < |i| <= s. */
struct TScaleTables {
    explicit TScaleTables(const TScaleSaliencyOptions& options);

    int sMin;
    int sMax;
    int bins;
    bool smooth;
    std::vector<int> area;                         //!< Pixels N(s) of disc(s).
    std::vector<int> innerSquare;                  //!< floor(s / sqrt(2)).
    std::vector<std::vector<TDiscRow>> outerRows;  //!< Rows j = m+1..s.
    std::vector<double> nLogN;                     //!< n log n, for n = 0..N(sMax).
    std::vector<double> dFactor;                   //!< 2 / (N(s) N(s-1)).
    std::vector<double> wFactor;                   //!< s^2 / (2s - 1).
    std::vector<double> wMax;                      //!< Largest W that any picture can have.
    double logTwo;                                 //!< log 2 in the chosen base.

    int scales() const { return sMax - sMin + 1; }
    double log(double x) const;

    /// D(sMin) := D(sMin+1), then smoothed in place; `d` begins at sMin, rows of `lanes` values.
    void smoothInPlace(double* d, int lanes) const;

    /// Whether discs modulo 256 tell their rings: true up to radius 40 if sMin <= 9.
    bool fitsBytes() const;

 private:
    void countDiscs();
    void boundW();
};

}  // namespace salma::saliency
