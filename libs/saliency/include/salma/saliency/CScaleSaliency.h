// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/observations/TSalientRegion.h>

#include <cstddef>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace salma::saliency {

struct TScaleTables;

enum class ELogBase { natural, two };

/// Instruction sets of the inner loops; all give the same numbers.
enum class ESimd {
    automatic,  //!< The best of the others that there is.
    portable,
    sse4,
    avx2,
    avx512,    //!< F, BW, CD, DQ, VL (Skylake-X).
    avx512dl,  //!< Those and VBMI, GFNI and more (Ice Lake, Zen 4).
    neon
};

/// Whether both this program and this processor know an instruction set.
bool hasSimd(ESimd simd);

/// The widest instruction set that both know.
ESimd bestSimd();

/// Section [saliency].
struct TScaleSaliencyOptions : public config::TStrictOptions<TScaleSaliencyOptions> {
    int scaleMin{3};                      //!< Smallest radius [px]; never the scale of a peak.
    int scaleMax{33};                     //!< Largest radius [px]; never the scale of a peak.
    int bins{16};                         //!< Cells of the histogram of the grey level.
    ELogBase logBase{ELogBase::natural};  //!< Unit of the entropy: nat or bit.
    bool smooth{true};                    //!< Smooth W over three scales, in place.
    bool stretch{false};                  //!< Stretch the picture's greys to 0..255 first.
    int threads{1};                       //!< Threads; the result does not depend on it.
    ESimd simd{ESimd::automatic};         //!< Instruction set; nor on it.

    void visit(config::COptionVisitor& v);
    /// \throw std::invalid_argument if there is no scale between the smallest and the largest.
    void validate() const;
};

/// Which peaks are wanted. The result is exactly what is left of all; the less, the faster.
struct TPeakLimits {
    double yMin{0};       //!< Only peaks with Y >= yMin.
    std::size_t best{0};  //!< Only so many, of the largest Y, the first of equal ones; 0 is all.
    cv::Rect centres{};   //!< Only centres in this part of the picture [px]; empty is everywhere.
};

/** Scale saliency of a picture: places and radii whose grey levels are most unpredictable.
 *
 * With p(s) the histogram of the disc of radius s about a pixel, H(s) its entropy, and
 * W(s) = s^2/(2s-1) sum |p(s) - p(s-1)| (smoothed), each scale with H(s-1) < H(s) > H(s+1) is a
 * peak of saliency Y = H W. A peak needs a margin of more than 1e-11 over both neighbours, so that
 * equal entropies are not split by rounding.
 * Source: T. Kadir and M. Brady, "Saliency, scale and image description", IJCV 45(2), 2001. */
class CScaleSaliency {
 public:
    /// \throw std::invalid_argument if options are out of range, or the processor lacks the
    /// instruction set.
    explicit CScaleSaliency(const TScaleSaliencyOptions& options = {});

    /** Entropy peaks whose disc of the largest scale fits into the picture, by row, column, scale.
     * \param picture [rows x cols], CV_8UC1, or CV_8UC3 and CV_8UC4 as OpenCV's BGR, whose grey
     * is taken; smaller than a disc gives an empty result.
     * \throw std::invalid_argument for another type of picture, or yMin not a number. */
    std::vector<observations::TSalientRegion> detect(const cv::Mat& picture,
                                                     const TPeakLimits& limits = {}) const;

    const TScaleSaliencyOptions& options() const { return m_options; }

 private:
    TScaleSaliencyOptions m_options;
    std::shared_ptr<const TScaleTables> m_tables;
};

}  // namespace salma::saliency
