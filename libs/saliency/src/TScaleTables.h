// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>

#include <cstdint>
#include <vector>

namespace salma::saliency {

constexpr int kLanes = 64;  // centres that are counted together

/** Where the sums are, relative to a centre's own column, that row j of disc(s) and its three
 * mirror images in the diagonals need. */
struct TRowTerms {
    std::int32_t rowRight{0};  //!< Of the pair of rows y+j and y-j: columns before x + half + 1,
    std::int32_t rowLeft{0};   //!< less those before x - half.
    std::int32_t columnRight{0};  //!< Rows y-half..y+half of column x+j,
    std::int32_t columnLeft{0};   //!< and of column x-j.
};

/** How to count a bin's pixels in all discs about kLanes centres of a row y.
 *
 * disc(s) = {i^2 + j^2 <= s^2} is cut into the square [-m,m]^2 with m = floor(s / sqrt(2)), the
 * rows m < |j| <= s and, by symmetry, the columns m < |i| <= s. Sums that several discs share are
 * kept in slots of `stride` columns. */
struct TDiscPlan {
    /// One shared sum, needed for columns first..last-1 of its slot.
    struct TSum {
        int size{0};  //!< j of a pair of rows, h of a column, m of a square.
        int first{0};
        int last{0};
        std::int32_t slot{0};  //!< Its first column.
    };
    struct TDisc {
        std::int32_t squareRight{0};
        std::int32_t squareLeft{0};
        std::vector<TRowTerms> rows;
    };

    int origin{0};  //!< Column of the first centre; half a cache line after a line's begin.
    int stride{0};  //!< An odd number of cache lines, so that rows spread over the cache.
    std::vector<TSum> rowPairs;  //!< Rows y+j and y-j, columns before x.
    std::vector<TSum> columns;   //!< Rows y-h..y+h of column x.
    std::vector<TSum> squares;   //!< Rows y-m..y+m, columns before x.
    std::vector<TDisc> discs;    //!< Of s = sMin..sMax.
    int scratchSize{0};          //!< Columns of all slots.
};

/// What depends on the options alone. Arrays are indexed by the radius s = 0..sMax [px].
struct TScaleTables {
    explicit TScaleTables(const TScaleSaliencyOptions& options);

    int sMin;
    int sMax;
    int bins;
    bool smooth;
    std::vector<int> area;        //!< Pixels N(s) of disc(s).
    std::vector<double> nLogN;    //!< n log n, for n = 0..N(sMax).
    std::vector<double> dFactor;  //!< 2 / (N(s) N(s-1)).
    std::vector<double> wFactor;  //!< s^2 / (2s - 1).
    std::vector<double> wMax;     //!< Largest W that any picture can have.
    double logTwo;                //!< log 2 in the chosen base.
    TDiscPlan plan;

    int scales() const { return sMax - sMin + 1; }
    double log(double x) const;

    /// Whether discs modulo 256 tell their rings: true up to radius 40 if sMin <= 9.
    bool fitsBytes() const;

 private:
    void countDiscs();
    void boundW();
    void planDiscs();
};

}  // namespace salma::saliency
