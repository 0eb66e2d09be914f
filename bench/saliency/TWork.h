// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>

#include <opencv2/core/mat.hpp>

namespace salma::bench {

/** How much the search for all peaks of a picture has to do, as its design in libs/saliency
 * demands: from the bins that occur in each tile, band and part. */
struct TWork {
    double centres{0};
    double tileBins{0};    //!< Bitmaps that are made.
    double ringPixels{0};  //!< Loads of bitmap words of a band (8 rows x 64 centres each).
    double fullAdders{0};  //!< That add those, on planes of bits.
    double halfAdders{0};  //!< Likewise.
    double rings{0};       //!< Counts of a ring in a band.
    double bandBins{0};    //!< Bins of bands, the one that is not counted among them.
    double bands{0};
    double sums{0};        //!< (bin, scale) of parts (32 centres).
    double partScales{0};  //!< Scales of parts.
};

/// \param grey CV_8UC1, larger than the window. \param options Without stretch.
TWork workFor(const cv::Mat& grey, const saliency::TScaleSaliencyOptions& options);

/// Cycles for each centre, by stage.
struct TBound {
    double bitmaps{0};
    double counting{0};
    double joining{0};
    double rest{0};   //!< The bin that is counted from the others.
    double sums{0};   //!< Counts, changes, entropies.
    double peaks{0};  //!< W, and marks of peaks.

    double total() const { return bitmaps + counting + joining + rest + sums + peaks; }
};

/// Of a processor and one of its instruction sets, in a cycle.
struct TThroughput {
    saliency::ESimd simd{saliency::ESimd::automatic};
    int bits{0};
    double operations{0};
    double multiplyAdds{0};
    double loads{0};
};

/** The least time for `work`: the operations of each stage on whole vectors at the throughput of
 * simple ones; or its unaligned loads, or its multiplications and conversions, at theirs, if those
 * take longer. What processors do on fewer ports (shifts, shuffles), what waits, stores, and the
 * decisions about single peaks are left out. \param speed Of a set with vectors. */
TBound boundOf(const TWork& work,
               const saliency::TScaleSaliencyOptions& options,
               const TThroughput& speed);

}  // namespace salma::bench
