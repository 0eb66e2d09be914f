// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>

#include <cstdint>
#include <vector>

namespace salma::saliency {

constexpr int kLanes = 64;  // centres of a row that are counted together
constexpr int kAtOnce = 8;  // ring pixels that are added at once

constexpr int kTileRows = 64;  // so that a bin's bitmap of a tile fits into a second-level cache
constexpr int kBandRows = 8;   // rows of centres that are counted together

/** A bin's bitmap over the window of a tile, made for counting: word (dx, row) has the bits of
 * kLanes neighbouring pixels, the first of which is dx columns right of the first centre. Words of
 * one dx stand one row after the other, so that one load takes the same ring pixel of kLanes
 * centres in each of several rows. */
struct TBitmapLayout {
    int reach{0};   //!< Both dx and the rows above the first centre go from -reach.
    int stride{0};  //!< Words of one dx: an odd number of cache lines.
    int zeros{0};   //!< First of `stride` words that are always 0.
    int size{0};    //!< Words in all.

    /// Of a pixel dx right of and dy below the centre; add the centre's row in the tile.
    std::int32_t offset(int dx, int dy) const { return (dx + reach) * stride + dy + reach; }
};

/// The pixels of ring(s) = {(s-1)^2 < i^2 + j^2 <= s^2}.
struct TRing {
    /// By row; filled up to a multiple of kAtOnce with zeros of the bitmap.
    std::vector<std::int32_t> offsets;
    std::vector<std::size_t> rowStarts;  //!< First of row dy, at dy + reach; one more at the end.
};

/** A scale's numbers for a bound of W in 16-bit arithmetic. With r of R ring pixels and n of the N
 * pixels of the disc before in a bin, the histogram changes by D = 2 R / (N + R) (1 - overlap),
 * overlap being the sum of min(r/R, n/N) over bins. */
struct TBoundScale {
    static constexpr int kWhole = 21845;  //!< A whole overlap; thrice that still is 16 bits.
    std::uint16_t whole{0};               //!< R perPixel, a little less than kWhole.
    std::uint16_t perPixel{0};            //!< Of the ring.
    std::uint16_t toTop{0};               //!< Power of two that brings N to 2^15 or more.
    std::uint16_t perTop{0};              //!< Of n toTop / 65536, rounded down.
    std::uint16_t toD{0};                 //!< Of (whole - overlap) / 65536, rounded down.
    double dUnit{0};                      //!< D of the result 1.
    float log2Area{0};                    //!< log2(N + R).
};

/// What depends on the options alone. Arrays are indexed by the radius s = 0..sMax [px].
struct TScaleTables {
    explicit TScaleTables(const TScaleSaliencyOptions& options);

    int sMin;
    int sMax;
    int bins;
    bool smooth;
    std::vector<int> area;           //!< Pixels N(s) of disc(s).
    std::vector<double> nLogN;       //!< n log n, for n = 0..N(sMax).
    std::vector<double> dFactor;     //!< 2 / (N(s) N(s-1)).
    std::vector<double> wFactor;     //!< s^2 / (2s - 1).
    std::vector<double> wMax;        //!< Largest W that any picture can have.
    double logTwo;                   //!< log 2 in the chosen base.
    std::vector<TBoundScale> bound;  //!< Of scales sMin..sMax.
    TBitmapLayout bitmap;
    std::vector<TRing> rings;  //!< Of scales sMin..sMax, the first being the whole disc.

    int scales() const { return sMax - sMin + 1; }
    double log(double x) const;

    /// Pixels of the ring at scale k, counted from sMin.
    int inRing(int k) const;

    /// Whether the number of a ring's pixels fits into a byte: true up to radius 38 if sMin <= 9.
    bool fitsBytes() const;

 private:
    void countDiscs();
    void boundW();
    void scaleBounds();
    void listRings();
};

}  // namespace salma::saliency
